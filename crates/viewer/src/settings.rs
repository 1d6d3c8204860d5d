//! What is kept from one start to the next.

use std::path::{Path, PathBuf};

use trimloop_render::Lod;

use crate::export::ExportOptions;
use crate::navigation::{Style, TwoFingers};
use crate::pick::Filter;

/// What is kept from one start to the next.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub(crate) struct Settings {
    pub style: Style,
    pub two_fingers: TwoFingers,
    pub filter: Filter,
    pub is_parallel: bool,
    pub are_statistics_shown: bool,
    pub has_cube: bool,
    pub export: ExportOptions,
    /// The strategy's name.
    pub lod: String,
    /// The last ones first.
    pub recent: Vec<PathBuf>,
}

/// Files that are remembered.
const MOST_RECENT: usize = 12;
/// Where they are kept.
pub(crate) const KEY: &str = "trimloop settings";

impl Default for Settings {
    fn default() -> Self {
        Self {
            style: Style::default(),
            two_fingers: TwoFingers::default(),
            filter: Filter::default(),
            is_parallel: false,
            are_statistics_shown: false,
            has_cube: true,
            export: ExportOptions::default(),
            lod: Lod::Adaptive.name().to_owned(),
            recent: Vec::new(),
        }
    }
}

impl Settings {
    /// Remembers that a file was opened.
    pub fn remember(&mut self, path: &Path) {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
        self.recent.retain(|own| *own != path);
        self.recent.insert(0, path);
        self.recent.truncate(MOST_RECENT);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recent_files_stand_once_and_the_last_one_first() {
        let mut settings = Settings::default();
        for k in 0..20 {
            settings.remember(Path::new(&format!("/a/{}.step", k % 15)));
        }
        assert_eq!(settings.recent.len(), MOST_RECENT);
        assert_eq!(settings.recent[0], Path::new("/a/4.step"));
        assert_eq!(settings.recent.iter().filter(|p| p.ends_with("4.step")).count(), 1);
    }
}
