//! Groups of rows, one for every recording.

use std::sync::Arc;

/// Rows that share noise and parameters with each other: those of every recording. With other groups they share parameters
/// only.
#[derive(Clone, Debug, PartialEq)]
pub struct RowGroups {
    groups: Arc<[Vec<usize>]>,
    /// The group of every row.
    of_row: Arc<[usize]>,
}

impl RowGroups {
    /// Builds the groups from the group of every row (`m`).
    pub fn new(of_row: Vec<usize>) -> Self {
        let count = of_row.iter().max().map_or(0, |last| last + 1);
        Self::of_count(of_row, count)
    }

    /// The same of so many groups, of which some may be empty.
    pub fn of_count(of_row: Vec<usize>, count: usize) -> Self {
        let mut groups = vec![Vec::new(); count];
        for (row, &group) in of_row.iter().enumerate() {
            groups[group].push(row);
        }
        Self {
            groups: groups.into(),
            of_row: of_row.into(),
        }
    }

    /// All rows in one group.
    pub fn whole(rows: usize) -> Self {
        Self::new(vec![0; rows])
    }

    /// The same with so many rows more, in a group of their own.
    pub fn with_group(&self, count: usize) -> Self {
        let more = std::iter::repeat_n(self.groups.len(), count);
        let of_row = self.of_row.iter().copied().chain(more);
        Self::of_count(of_row.collect(), self.groups.len() + 1)
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.of_row.len()
    }

    /// The rows of every group, in ascending order.
    pub fn iter(&self) -> std::slice::Iter<'_, Vec<usize>> {
        self.groups.iter()
    }

    /// The group of a row.
    pub fn of(&self, row: usize) -> usize {
        self.of_row[row]
    }

    /// The place of a row in its group.
    pub fn place(&self, row: usize) -> usize {
        let own = &self.groups[self.of(row)];
        own.binary_search(&row).unwrap_or(0)
    }

    /// The groups of the first `end` rows.
    pub fn before(&self, end: usize) -> Self {
        Self::of_count(self.of_row[..end].to_vec(), self.groups.len())
    }

    /// Groups with rows of one of these sets as one.
    pub fn connected<'a>(&self, sets: impl Iterator<Item = &'a [usize]>) -> Self {
        let mut joined: Vec<usize> = (0..self.groups.len()).collect();
        for rows in sets {
            let Some(&first) = rows.first() else { continue };
            let to = joined[self.of(first)];
            for &row in rows {
                let from = joined[self.of(row)];
                if from != to {
                    let own = joined.iter_mut().filter(|j| **j == from);
                    own.for_each(|j| *j = to);
                }
            }
        }
        if joined.iter().enumerate().all(|(group, to)| group == *to) {
            return self.clone();
        }
        let mut kept = joined.clone();
        kept.sort_unstable();
        kept.dedup();
        let place = |row: &usize| kept.binary_search(&joined[*row]).unwrap_or(0);
        Self::new(self.of_row.iter().map(place).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_two_groups_in_one_set_make_one_group_of_them() {
        let groups = RowGroups::new(vec![0, 1, 2, 0, 1, 2]);
        let rows: Vec<&Vec<usize>> = groups.iter().collect();
        assert_eq!(rows, [&vec![0, 3], &vec![1, 4], &vec![2, 5]]);
        assert_eq!(groups.connected([&[0, 3][..]].into_iter()), groups);
        let joined = groups.connected([&[1, 5][..]].into_iter());
        let rows: Vec<&Vec<usize>> = joined.iter().collect();
        assert_eq!(rows, [&vec![0, 3], &vec![1, 2, 4, 5]]);
        assert_eq!((joined.of(4), joined.place(4)), (1, 2));
    }
}
