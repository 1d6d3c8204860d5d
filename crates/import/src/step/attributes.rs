//! Reading an entity's attributes in order.

use std::borrow::Cow;

use trimloop_part21::{Args, Param};

use super::fault::{Fault, Outcome};
use super::keyword::inheritance_rank;
use super::table::Table;

/// The largest magnitude of a number that is taken for one; beyond it, sums of squares would soon overflow.
const LARGEST: f64 = 1e30;

/// An entity's attributes, read one after the other in the order that its EXPRESS declaration gives them.
#[derive(Clone)]
pub(crate) struct Attributes<'t> {
    table: &'t Table<'t>,
    index: usize,
    params: Params<'t>,
}

#[derive(Clone)]
enum Params<'t> {
    Simple(Args<'t>),
    Complex(std::vec::IntoIter<Param<'t>>),
}

impl<'t> Attributes<'t> {
    /// All attributes of an entity; those of a complex instance in order of inheritance.
    pub fn new(table: &'t Table<'t>, index: usize) -> Self {
        let instance = table.instance(index);
        let params = if instance.is_complex() {
            let mut parts: Vec<_> = instance.parts().collect();
            parts.sort_by_key(|(keyword, _)| inheritance_rank(keyword));
            Params::Complex(parts.into_iter().flat_map(|(_, args)| args).collect::<Vec<_>>().into_iter())
        } else {
            Params::Simple(instance.args())
        };
        Self { table, index, params }
    }

    /// The attributes of one part of a complex instance; of all when the instance is simple.
    pub fn of_part(table: &'t Table<'t>, index: usize, keyword: &str) -> Option<Self> {
        let instance = table.instance(index);
        if !instance.is_complex() {
            return Some(Self::new(table, index));
        }
        instance.part(keyword).map(|args| Self { table, index, params: Params::Simple(args) })
    }

    /// The next attribute as it is.
    pub fn param(&mut self) -> Option<Param<'t>> {
        match &mut self.params {
            Params::Simple(args) => args.next(),
            Params::Complex(params) => params.next(),
        }
    }

    /// Leaves out `count` attributes.
    pub fn skip(&mut self, count: usize) {
        for _ in 0..count {
            self.param();
        }
    }

    /// The same, for chaining.
    pub fn after(mut self, count: usize) -> Self {
        self.skip(count);
        self
    }

    /// A fault of this entity.
    pub fn fault(&self, message: impl AsRef<str>) -> Fault {
        let name = self.table.type_name(self.index);
        Fault::new(self.table.id(self.index), format!("{name}: {}", message.as_ref()))
    }

    /// A reference to an entity that exists.
    pub fn reference(&mut self, what: &str) -> Outcome<usize> {
        match self.param() {
            Some(param) => self.resolve(param, what),
            None => Err(self.fault(format!("{what} is missing"))),
        }
    }

    /// The instance name of a reference, whether it resolves or not.
    pub fn id(&mut self, what: &str) -> Outcome<u64> {
        match self.param() {
            Some(Param::Reference(id)) => Ok(id),
            _ => Err(self.fault(format!("{what} is not a reference"))),
        }
    }

    /// A reference, where one is given and resolves.
    pub fn optional_reference(&mut self) -> Option<usize> {
        match self.param()? {
            Param::Reference(id) => self.table.find(id),
            _ => None,
        }
    }

    /// References to entities that all exist.
    pub fn references(&mut self, what: &str) -> Outcome<Vec<usize>> {
        self.list(what)?.map(|param| self.resolve(param, what)).collect()
    }

    /// Instance names, whether they resolve or not; what is no reference is left out.
    pub fn ids(&mut self, what: &str) -> Outcome<Vec<u64>> {
        let ids = self.list(what)?.filter_map(|param| match param {
            Param::Reference(id) => Some(id),
            _ => None,
        });
        Ok(ids.collect())
    }

    /// Those of a list of references that exist; none when there is no list.
    pub fn found_references(&mut self) -> Vec<usize> {
        self.ids("").unwrap_or_default().into_iter().filter_map(|id| self.table.find(id)).collect()
    }

    /// A list.
    pub fn list(&mut self, what: &str) -> Outcome<Args<'t>> {
        match self.param() {
            Some(Param::List(items)) => Ok(items),
            _ => Err(self.fault(format!("{what} is not a list"))),
        }
    }

    /// A finite number of sensible size.
    pub fn real(&mut self, what: &str) -> Outcome<f64> {
        let param = self.param();
        self.number(param, what)
    }

    /// A number where one is given.
    pub fn optional_real(&mut self) -> Option<f64> {
        number_of(self.param()?, 0)
    }

    /// A list of numbers.
    pub fn reals(&mut self, what: &str) -> Outcome<Vec<f64>> {
        self.list(what)?.map(|param| self.number(Some(param), what)).collect()
    }

    /// A whole number that is not negative.
    pub fn count(&mut self, what: &str) -> Outcome<usize> {
        match self.param() {
            Some(Param::Integer(value)) if value >= 0 => Ok(value as usize),
            Some(Param::Real(value)) if value >= 0.0 && value.fract() == 0.0 && value < 1e9 => {
                Ok(value as usize)
            }
            _ => Err(self.fault(format!("{what} is not a count"))),
        }
    }

    /// A list of whole numbers that are not negative.
    pub fn counts(&mut self, what: &str) -> Outcome<Vec<usize>> {
        let list = self.list(what)?;
        list.map(|param| match param {
            Param::Integer(value) if value >= 0 => Ok(value as usize),
            _ => Err(self.fault(format!("{what} holds what is not a count"))),
        })
        .collect()
    }

    /// A truth value; anything but `.F.` counts as true, as most exporters mean it.
    pub fn flag(&mut self) -> bool {
        !matches!(self.param(), Some(Param::Enumeration("F" | "f" | "FALSE")))
    }

    /// The name of an enumeration value.
    pub fn enumeration(&mut self) -> Option<&'t str> {
        match self.param()? {
            Param::Enumeration(name) => Some(name),
            _ => None,
        }
    }

    /// A string; empty when there is none.
    pub fn text(&mut self) -> Cow<'t, str> {
        match self.param() {
            Some(Param::String(text)) => text.decode(),
            Some(Param::Typed(_, mut args)) => match args.next() {
                Some(Param::String(text)) => text.decode(),
                _ => Cow::Borrowed(""),
            },
            _ => Cow::Borrowed(""),
        }
    }

    /// `param` as a finite number of sensible size.
    pub fn number(&self, param: Option<Param<'t>>, what: &str) -> Outcome<f64> {
        let number = param.and_then(|param| number_of(param, 0));
        number.ok_or_else(|| self.fault(format!("{what} is not a usable number")))
    }

    fn resolve(&self, param: Param<'t>, what: &str) -> Outcome<usize> {
        let Param::Reference(id) = param else {
            return Err(self.fault(format!("{what} is not a reference")));
        };
        self.table.find(id).ok_or_else(|| self.fault(format!("{what} #{id} is missing from the file")))
    }
}

/// A number, also one that is wrapped in its measure type.
fn number_of(param: Param<'_>, depth: usize) -> Option<f64> {
    let number = match param {
        Param::Real(value) => value,
        Param::Integer(value) => value as f64,
        Param::Typed(_, mut args) if depth < 4 => number_of(args.next()?, depth + 1)?,
        _ => return None,
    };
    (number.abs() <= LARGEST).then_some(number)
}
