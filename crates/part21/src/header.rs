//! The HEADER section.

use crate::{Args, Param};

/// What the HEADER section says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Header {
    /// FILE_DESCRIPTION description.
    pub description: Vec<String>,
    /// FILE_DESCRIPTION implementation_level.
    pub implementation_level: String,
    /// FILE_NAME name.
    pub name: String,
    /// FILE_NAME time_stamp.
    pub time_stamp: String,
    /// FILE_NAME author.
    pub author: Vec<String>,
    /// FILE_NAME organization.
    pub organization: Vec<String>,
    /// FILE_NAME preprocessor_version.
    pub preprocessor_version: String,
    /// FILE_NAME originating_system.
    pub originating_system: String,
    /// FILE_NAME authorization.
    pub authorization: String,
    /// FILE_SCHEMA.
    pub schemas: Vec<String>,
}

impl Header {
    /// Takes over one entity of the section; those it has no place for are ignored.
    pub(crate) fn take(&mut self, keyword: &str, mut args: Args) {
        match keyword.to_ascii_uppercase().as_str() {
            "FILE_DESCRIPTION" => {
                self.description = strings(args.next());
                self.implementation_level = string(args.next());
            }
            "FILE_NAME" => {
                self.name = string(args.next());
                self.time_stamp = string(args.next());
                self.author = strings(args.next());
                self.organization = strings(args.next());
                self.preprocessor_version = string(args.next());
                self.originating_system = string(args.next());
                self.authorization = string(args.next());
            }
            "FILE_SCHEMA" => self.schemas = strings(args.next()),
            _ => {}
        }
    }
}

/// A string, or the first of a list of strings, which some writers give instead; else nothing.
pub(crate) fn string(param: Option<Param>) -> String {
    match param {
        Some(Param::String(text)) => text.decode().into_owned(),
        Some(Param::List(list)) => strings(Some(Param::List(list))).into_iter().next().unwrap_or_default(),
        _ => String::new(),
    }
}

/// The strings of a list, or a single one where a writer gives no list.
pub(crate) fn strings(param: Option<Param>) -> Vec<String> {
    let text = |param| match param {
        Param::String(text) => Some(text.decode().into_owned()),
        _ => None,
    };
    match param {
        Some(Param::List(list)) => list.filter_map(text).collect(),
        Some(other) => text(other).into_iter().collect(),
        None => Vec::new(),
    }
}
