//! Where entities' parameters point to what the entities are made of, and where their own parameters end
//! (IGES 5.3 chapter 4).

use trimloop_iges::{Entity, Value};

/// What an entity's parameters are, beyond their meaning.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Layout {
    /// The entities that it is made of, which are not shown beside it.
    pub parts: Vec<u32>,
    /// The entities of its second list of additional pointers: properties and attributes (section 2.2.4.5.2).
    pub properties: Vec<u32>,
}

impl Layout {
    /// The layout of an entity; nothing where its type is not known.
    pub fn of(entity: &Entity<'_>) -> Self {
        let (kind, form) = (entity.directory.entity_type, entity.directory.form);
        if !is_known(kind) {
            return Self::default();
        }
        let values: Vec<Value<'_>> = entity.values().collect();
        let reader = Places { values: &values };
        let (own, places) = reader.own_and_parts(kind, form);
        Self {
            parts: places.into_iter().filter_map(|place| reader.pointer(place)).collect(),
            properties: reader.properties(own),
        }
    }
}

/// Types whose pointers matter here: those that others are made of, and those that have names.
fn is_known(kind: i32) -> bool {
    matches!(
        kind,
        102 | 108
            | 118..=122
            | 130
            | 140..=144
            | 150..=168
            | 180
            | 184
            | 186
            | 190..=198
            | 308
            | 402
            | 408
            | 412
            | 414
            | 430
            | 502..=514
            | 128
            | 114
    )
}

struct Places<'v> {
    values: &'v [Value<'v>],
}

impl Places<'_> {
    /// A count; no more than there are parameters.
    fn count(&self, place: usize) -> usize {
        let count = self.values.get(place).and_then(Value::integer).unwrap_or(0);
        count.clamp(0, self.values.len() as i64) as usize
    }

    fn pointer(&self, place: usize) -> Option<u32> {
        let value = self.values.get(place)?.integer()?;
        u32::try_from(value.unsigned_abs()).ok().filter(|entry| entry % 2 == 1)
    }

    /// The place after the entity's own parameters, and the places of the pointers to its parts.
    fn own_and_parts(&self, kind: i32, form: i32) -> (usize, Vec<usize>) {
        let n = |place: usize| self.count(place);
        let list = |first: usize, count: usize, stride: usize| -> Vec<usize> {
            (first..self.values.len()).step_by(stride).take(count).collect()
        };
        let with_axes = usize::from(form == 1);
        match kind {
            102 => (2 + n(1), list(2, n(1), 1)),
            108 => (10, vec![5]),
            114 => {
                let [m, n] = [n(3), n(4)];
                (5 + m + 1 + n + 1 + 48usize.saturating_mul((m + 1).saturating_mul(n + 1)), Vec::new())
            }
            118 => (5, vec![1, 2]),
            120 => (5, vec![1, 2]),
            122 => (5, vec![1]),
            128 => {
                let [k, l, p, q] = [n(1), n(2), n(3), n(4)];
                let poles = (k + 1).saturating_mul(l + 1);
                (10 + k + p + 2 + l + q + 2 + poles.saturating_mul(4) + 4, Vec::new())
            }
            130 => (15, vec![1, 3]),
            140 => (6, vec![5]),
            141 => self.boundary(),
            142 => (6, vec![2, 3, 4]),
            143 => (4 + n(3), [vec![2], list(4, n(3), 1)].concat()),
            // The outer boundary stands before the inner ones.
            144 => (5 + n(3), [vec![1], list(4, 1 + n(3), 1)].concat()),
            150 | 168 => (13, Vec::new()),
            152 => (14, Vec::new()),
            154 | 160 => (9, Vec::new()),
            156 => (10, Vec::new()),
            158 => (5, Vec::new()),
            162 => (9, vec![1]),
            164 => (6, vec![1]),
            180 => (2 + n(1), self.operands(n(1))),
            184 => (2 + 2 * n(1), list(2, n(1), 1)),
            186 => (4 + 2 * n(3), [vec![1], list(4, n(3), 2)].concat()),
            190 => (3 + with_axes, vec![1, 2, 3]),
            192 => (4 + with_axes, vec![1, 2, 4]),
            194 | 198 => (5 + with_axes, vec![1, 2, 5]),
            196 => (3 + 2 * with_axes, vec![1, 3, 4]),
            308 => (4 + n(3), list(4, n(3), 1)),
            402 => (2 + n(1), list(2, n(1), 1)),
            408 => (6, vec![1]),
            412 => (13 + n(11), vec![1]),
            414 => (11 + n(9), vec![1]),
            430 => (2, vec![1]),
            502 => (2 + 3 * n(1), Vec::new()),
            504 => (2 + 5 * n(1), list(2, n(1), 5)),
            508 => (usize::MAX, Vec::new()),
            510 => (4 + n(2), [vec![1], list(4, n(2), 1)].concat()),
            514 => (2 + 2 * n(1), list(2, n(1), 2)),
            _ => (usize::MAX, Vec::new()),
        }
    }

    /// Type 141: each curve in the model is followed by a sense and by its curves in the parameter plane.
    fn boundary(&self) -> (usize, Vec<usize>) {
        let mut places = vec![3];
        let mut at = 5;
        for _ in 0..self.count(4) {
            let in_plane = self.count(at + 2);
            places.push(at);
            places.extend(at + 3..at + 3 + in_plane);
            at += 3 + in_plane;
            if at >= self.values.len() {
                break;
            }
        }
        (at, places)
    }

    /// Type 180: operands are pointers with their sign turned, operations are positive.
    fn operands(&self, count: usize) -> Vec<usize> {
        let is_operand =
            |place: &usize| self.values.get(*place).and_then(Value::integer).is_some_and(|v| v < 0);
        (2..2 + count).filter(is_operand).collect()
    }

    /// After the own parameters: how many entities refer to this one, those, how many properties it has, those.
    fn properties(&self, own: usize) -> Vec<u32> {
        if own >= self.values.len() {
            return Vec::new();
        }
        let first = own + 1 + self.count(own);
        let count = self.count(first);
        (first + 1..self.values.len()).take(count).filter_map(|place| self.pointer(place)).collect()
    }
}
