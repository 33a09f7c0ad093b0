//! Matrices and vectors of a case: constant, or one per observation.

use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};

use super::Entry;
use super::entry::{bare_number, number_refused};
use crate::matrix::Matrix;
use crate::scalar::Rational;

/// A constant, or one value per observation (nothing where no observation depends on it).
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(untagged)]
pub enum Along<T> {
    /// The same for every k.
    Constant(T),
    /// One for each k.
    PerStep(Vec<Option<T>>),
}

/// A matrix as a list of rows. They may be ragged: a bad case must be able to travel.
pub type Rows = Vec<Vec<Entry>>;
/// A matrix, constant or one per observation.
pub type Matrices = Along<Rows>;
/// A vector, constant or one per observation.
pub type Vectors = Along<Vec<Entry>>;

/// The rows of a matrix, each entry as text by `text`.
pub(super) fn rows_of<T>(matrix: &Matrix<T>, text: impl Fn(&T) -> Entry) -> Rows {
    (0..matrix.rows()).map(|i| matrix.row(i).iter().map(&text).collect()).collect()
}

impl Along<Rows> {
    /// A constant matrix of doubles.
    pub fn constant(matrix: &Matrix<f64>) -> Self {
        Self::Constant(rows_of(matrix, |entry| (*entry).into()))
    }

    /// A constant matrix of fractions, for exact cases.
    pub fn exact(matrix: &Matrix<Rational>) -> Self {
        Self::Constant(rows_of(matrix, |entry| entry.into()))
    }

    /// One matrix of doubles per observation, nothing where no observation depends on it.
    pub fn per_step<'a>(matrices: impl IntoIterator<Item = Option<&'a Matrix<f64>>>) -> Self {
        let rows = |matrix: &Matrix<f64>| rows_of(matrix, |entry| (*entry).into());
        Self::PerStep(matrices.into_iter().map(|matrix| matrix.map(rows)).collect())
    }
}

impl Along<Vec<Entry>> {
    /// A constant vector of doubles.
    pub fn constant(vector: &[f64]) -> Self {
        Self::Constant(vector.iter().copied().map(Entry::from).collect())
    }

    /// One vector of doubles per observation, nothing where no observation depends on it.
    pub fn per_step<'a>(vectors: impl IntoIterator<Item = Option<&'a [f64]>>) -> Self {
        let entries = |vector: &[f64]| vector.iter().copied().map(Entry::from).collect();
        Self::PerStep(vectors.into_iter().map(|vector| vector.map(entries)).collect())
    }
}

impl<'de> Deserialize<'de> for Along<Rows> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (tree, per_step) = Levels::new(3).read(deserializer)?;
        Ok(if per_step { Self::PerStep(tree.steps(Tree::rows)) } else { Self::Constant(tree.rows()) })
    }
}

impl<'de> Deserialize<'de> for Along<Vec<Entry>> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (tree, per_step) = Levels::new(2).read(deserializer)?;
        Ok(if per_step { Self::PerStep(tree.steps(Tree::entries)) } else { Self::Constant(tree.entries()) })
    }
}

/// Nested lists as they were read; [`Levels`] keeps all strings on one level.
enum Tree {
    Null,
    Leaf(Entry),
    List(Vec<Tree>),
}

impl Tree {
    fn items(self) -> Vec<Self> {
        if let Self::List(items) = self { items } else { Vec::new() }
    }

    fn entries(self) -> Vec<Entry> {
        self.items()
            .into_iter()
            .filter_map(|item| if let Self::Leaf(entry) = item { Some(entry) } else { None })
            .collect()
    }

    fn rows(self) -> Rows {
        self.items().into_iter().map(Self::entries).collect()
    }

    fn steps<T>(self, value: impl Fn(Self) -> T) -> Vec<Option<T>> {
        let some = |item| if matches!(item, Self::Null) { None } else { Some(value(item)) };
        self.items().into_iter().map(some).collect()
    }
}

/// On which level of the lists the number strings lie: `deepest` if there is one value per observation, one
/// above it if the value is constant. The first string, list or null that decides it binds the rest, so that an
/// error is found at its own place.
struct Levels {
    deepest: usize,
    strings: Option<usize>,
    /// Lists have been seen down to the level above this one.
    lists: usize,
}

impl Levels {
    fn new(deepest: usize) -> Self {
        Self { deepest, strings: None, lists: 0 }
    }

    /// The lists, and whether there is one value per observation.
    fn read<'de, D: Deserializer<'de>>(mut self, deserializer: D) -> Result<(Tree, bool), D::Error> {
        let tree = Place { levels: &mut self, level: 0 }.deserialize(deserializer)?;
        let per_step = self.strings.map_or(self.lists == self.deepest, |level| level == self.deepest);
        Ok((tree, per_step))
    }

    /// What may stand on a level.
    fn expected(&self, level: usize) -> &'static str {
        let constant = self.strings == Some(self.deepest - 1);
        match (level, self.deepest - level.min(self.deepest)) {
            (0, 2) => "a vector (a list of number strings), or a list of one vector per observation",
            (0, _) => "a matrix (a list of rows), or a list of one matrix per observation",
            (_, 0) => "a number as a string",
            (1, 2) if constant => "a row (a list of number strings)",
            (1, 2) => "a row or a matrix",
            (_, 1) if constant => "a number as a string",
            (1, 1) => "a number as a string, or a vector",
            (_, _) => "a number as a string, or a row",
        }
    }
}

struct Place<'a> {
    levels: &'a mut Levels,
    level: usize,
}

impl<'de> DeserializeSeed<'de> for Place<'_> {
    type Value = Tree;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Tree, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl Place<'_> {
    fn refused<E: Error>(&self, found: &str) -> E {
        let expected = self.levels.expected(self.level);
        E::custom(format_args!("{found} where {expected} is expected; number strings stand all on one level of lists"))
    }
}

impl<'de> Visitor<'de> for Place<'_> {
    type Value = Tree;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.levels.expected(self.level))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Tree, E> {
        let Levels { deepest, strings, lists } = *self.levels;
        let fits = strings.map_or((deepest - 1..=deepest).contains(&self.level), |level| level == self.level);
        if !fits || lists > self.level {
            return Err(self.refused("a string"));
        }
        self.levels.strings = Some(self.level);
        Ok(Tree::Leaf(text.into()))
    }

    fn visit_unit<E: Error>(self) -> Result<Tree, E> {
        let per_step = self.levels.strings.is_none_or(|level| level == self.levels.deepest);
        if self.level != 1 || !per_step {
            return Err(self.refused("null"));
        }
        self.levels.strings = Some(self.levels.deepest);
        Ok(Tree::Null)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Tree, A::Error> {
        let strings = self.levels.strings.unwrap_or(self.levels.deepest);
        if self.level >= strings {
            return Err(self.refused("a list"));
        }
        self.levels.lists = self.levels.lists.max(self.level + 1);
        let mut list = Vec::new();
        while let Some(item) = items.next_element_seed(Place { levels: self.levels, level: self.level + 1 })? {
            list.push(item);
        }
        Ok(Tree::List(list))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Tree, E> {
        Err(bare_number(&number.to_string()))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Tree, E> {
        Err(bare_number(&number.to_string()))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Tree, A::Error> {
        Err(number_refused(map, &self))
    }
}
