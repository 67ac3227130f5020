//! Covariances of what is passed on from station to station: a few numbers at a time are all that later rows share with
//! earlier ones.

use nalgebra::DMatrix;

use super::exposure::Exposure;
use super::stations::Stations;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::blocks::covariance::Covariance;

/// A covariance `C` of rows along the lines of stations. Of a later station `j` and an earlier one `i`
/// `C_ji = G_j K_j ⋯ K_{i+1} H_iᵀ`, `K` diagonal: a state of `s` numbers is passed on, of which each station keeps a
/// part, gives and takes.
#[derive(Clone, Debug)]
pub struct Chain {
    stations: Stations,
    links: Vec<Option<Link>>,
    /// `s`.
    width: usize,
}

/// The part of one station of `d` rows.
#[derive(Clone, Debug)]
pub struct Link {
    /// `C_jj` (`d × d`).
    pub own: DMatrix<f64>,
    /// `G` (`d × s`): what the rows have of the state.
    pub gives: DMatrix<f64>,
    /// `H` (`d × s`): what the state is told by them.
    pub takes: DMatrix<f64>,
    /// The diagonal of `K` (`s`): what is kept of the state on the way to here.
    pub keeps: Vec<f64>,
}

impl Chain {
    /// Builds an empty chain: a covariance of zeros.
    pub fn none(stations: &Stations) -> Self {
        Self::of_width(stations, 0)
    }

    fn of_width(stations: &Stations, width: usize) -> Self {
        Self {
            links: vec![None; stations.all().len()],
            stations: stations.clone(),
            width,
        }
    }

    /// Builds the chain of links, each at the station that begins with the given row.
    pub fn of_links(
        stations: &Stations,
        width: usize,
        links: impl Iterator<Item = (usize, Link)>,
    ) -> Self {
        let mut chain = Self::of_width(stations, width);
        let of_row = stations.of_first_row(stations.rows());
        for (row, link) in links {
            if let Some(station) = of_row[row] {
                chain.links[station] = Some(link);
            }
        }
        chain
    }

    /// A walk of unit density. Before the reference time the nearer of two stations is the later one; on either side of it
    /// and for every path it begins anew.
    pub fn of_walk(stations: &Stations, exposures: &[Exposure]) -> Self {
        let mut chain = Self::of_width(stations, 3);
        let of_row = stations.of_first_row(stations.rows());
        let mut of_station = vec![None; stations.all().len()];
        for exposure in exposures {
            if let Some(station) = of_row[exposure.rows.start] {
                of_station[station] = Some(exposure);
            }
        }
        let mut before = None;
        for (link, exposure) in chain.links.iter_mut().zip(of_station) {
            let Some(exposure) = exposure else { continue };
            let path = (exposure.recording, exposure.after);
            let goes_on = before.replace(path) == Some(path);
            let (gives, takes) = match exposure.after {
                true => (&exposure.total, &exposure.moment),
                false => (&exposure.moment, &exposure.total),
            };
            *link = Some(Link {
                own: exposure.own.clone(),
                gives: gives.clone(),
                takes: takes.clone(),
                keeps: vec![f64::from(u8::from(goes_on)); 3],
            });
        }
        chain
    }

    /// Builds the chain of a covariance among the rows of each station; rows of different stations share nothing.
    pub fn of_each(stations: &Stations, covariance: &Covariance) -> Self {
        let own = |rows: Vec<usize>| {
            let own = covariance.part(&rows)?;
            let d = rows.len();
            let link = Link {
                own: DMatrix::from_fn(d, d, |i, k| own[(i, k)]),
                gives: DMatrix::zeros(d, 0),
                takes: DMatrix::zeros(d, 0),
                keeps: Vec::new(),
            };
            Some((rows[0], link))
        };
        let all = stations.all().iter();
        let links = all.filter_map(|station| own(station.rows.clone().collect()));
        Self::of_links(stations, 0, links)
    }

    /// `U Uᵀ` of columns of which each reaches a few stations of one line that follow each other: the state holds
    /// those that are not over yet.
    pub fn of_columns(stations: &Stations, columns: &Columns) -> Self {
        let all = stations.all();
        let mut reach: Vec<Option<(usize, usize)>> = vec![None; columns.ncols()];
        let mut at_station: Vec<Vec<(usize, Vec<f64>)>> = vec![Vec::new(); all.len()];
        for (k, station) in all.iter().enumerate() {
            let rows: Vec<usize> = station.rows.clone().collect();
            for &column in columns.columns_of_row(rows[0]) {
                let values: Vec<f64> = rows.iter().map(|&row| columns.get(row, column)).collect();
                if values.iter().any(|v| *v != 0.0) {
                    let first = reach[column].map_or(k, |(first, _)| first);
                    reach[column] = Some((first, k));
                    at_station[k].push((column, values));
                }
            }
        }
        let (slots, width) = slots(&reach);
        let mut chain = Self::of_width(stations, width);
        for (k, own) in at_station.into_iter().enumerate() {
            if own.is_empty() {
                continue;
            }
            let mut values = DMatrix::zeros(all[k].rows.len(), width);
            let mut keeps = vec![1.0; width];
            for (column, column_values) in own {
                let slot = slots[column];
                values.column_mut(slot).copy_from_slice(&column_values);
                if reach[column].is_some_and(|(first, _)| first == k) {
                    keeps[slot] = 0.0;
                }
            }
            chain.links[k] = Some(Link {
                own: &values * values.transpose(),
                gives: values.clone(),
                takes: values,
                keeps,
            });
        }
        chain
    }

    /// The same with `T Xᵀ + X Tᵀ` of some columns added (`T`, `X` `d × q` of the stations).
    pub fn with_both(&self, of_station: impl Fn(usize) -> Option<[DMatrix<f64>; 2]>) -> Self {
        let all = self.stations.all();
        let both: Vec<Option<[DMatrix<f64>; 2]>> = (0..all.len()).map(of_station).collect();
        let more = both.iter().flatten().next().map_or(0, |[t, _]| t.ncols());
        let width = self.width + 2 * more;
        let mut chain = Self::of_width(&self.stations, width);
        for (k, (own, both)) in self.links.iter().zip(both).enumerate() {
            let d = all[k].rows.len();
            let mut link = Link {
                own: DMatrix::zeros(d, d),
                gives: DMatrix::zeros(d, width),
                takes: DMatrix::zeros(d, width),
                keeps: vec![1.0; width],
            };
            if let Some(own) = own {
                link.own += &own.own;
                link.gives.columns_mut(0, self.width).copy_from(&own.gives);
                link.takes.columns_mut(0, self.width).copy_from(&own.takes);
                link.keeps[..self.width].copy_from_slice(&own.keeps);
            }
            if let Some([t, x]) = both {
                let cross = &t * x.transpose();
                link.own += &cross + cross.transpose();
                let (first, second) = (self.width, self.width + more);
                link.gives.columns_mut(first, more).copy_from(&t);
                link.takes.columns_mut(first, more).copy_from(&x);
                link.gives.columns_mut(second, more).copy_from(&x);
                link.takes.columns_mut(second, more).copy_from(&t);
            }
            chain.links[k] = Some(link);
        }
        chain
    }

    /// The stations.
    pub fn stations(&self) -> &Stations {
        &self.stations
    }

    /// The part of every station.
    pub fn links(&self) -> &[Option<Link>] {
        &self.links
    }

    /// Numbers of the state `s`.
    pub fn width(&self) -> usize {
        self.width
    }

    /// The whole matrix (`m × m`), every pair of stations written out.
    #[cfg(test)]
    pub(crate) fn to_dense(&self) -> DMatrix<f64> {
        let (all, m) = (self.stations.all(), self.stations.rows());
        let mut whole = DMatrix::zeros(m, m);
        let put = |whole: &mut DMatrix<f64>, (i, k): (usize, usize), block: &DMatrix<f64>| {
            let (a, b) = (all[i].rows.start, all[k].rows.start);
            whole
                .view_mut((a, b), (block.nrows(), block.ncols()))
                .copy_from(block);
        };
        for (j, later) in self.links.iter().enumerate() {
            let Some(later) = later else { continue };
            put(&mut whole, (j, j), &later.own);
            let mut gives = later.gives.clone();
            let mut keeps = later.keeps.clone();
            for i in (0..j).rev().take_while(|&i| all[i].line == all[j].line) {
                let Some(earlier) = &self.links[i] else {
                    continue;
                };
                for (k, kept) in keeps.iter().enumerate() {
                    gives.column_mut(k).scale_mut(*kept);
                }
                let block = &gives * earlier.takes.transpose();
                put(&mut whole, (j, i), &block);
                put(&mut whole, (i, j), &block.transpose());
                keeps.clone_from(&earlier.keeps);
            }
        }
        whole
    }
}

/// A slot of the state for every column from its first station to its last, and how many there are.
fn slots(reach: &[Option<(usize, usize)>]) -> (Vec<usize>, usize) {
    let mut order: Vec<(usize, usize, usize)> = reach
        .iter()
        .enumerate()
        .filter_map(|(column, reach)| reach.map(|(first, last)| (first, column, last)))
        .collect();
    order.sort_unstable();
    let mut ends: Vec<usize> = Vec::new();
    let mut slots = vec![0; reach.len()];
    for (first, column, last) in order {
        let free = ends.iter().position(|&end| end < first);
        let slot = free.unwrap_or(ends.len());
        match free {
            Some(slot) => ends[slot] = last,
            None => ends.push(last),
        }
        slots[column] = slot;
    }
    (slots, ends.len())
}
