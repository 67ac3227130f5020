//! The neighbours of blocks that were eliminated, and which of them meet in a block of `S`.

/// No neighbour.
const NONE: u32 = u32::MAX;

/// Share of the rows from which they are looked for one by one rather than sorted: one in so many.
const FEW: usize = 8;

/// A block that is left and meets an eliminated one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neighbour {
    /// Its position, less the number eliminated.
    pub position: u32,
    pub width: u32,
    /// First unknown, less the eliminated ones.
    pub first: u32,
    /// Begin of its `Y`.
    pub at: u32,
}

/// A neighbour and its partner in the column at hand.
#[derive(Clone, Copy, Debug, Default)]
struct Pair {
    /// Begins of the `Y` of both.
    row: u32,
    column: u32,
    /// The next one in the same row.
    next: u32,
}

/// The neighbours of many eliminated blocks, by the column and the row of `S` in which they meet.
#[derive(Debug, Default)]
pub(crate) struct Neighbours {
    /// One block after the other, ascending within each.
    all: Vec<Neighbour>,
    /// Ends of those of every block.
    ends: Vec<u32>,
    /// Neighbours by their position, each with the end of its block's.
    members: Vec<(u32, u32)>,
    /// First member of every position, and their number.
    start: Vec<u32>,
    /// One for every neighbour.
    pairs: Vec<Pair>,
    /// First pair of every row of the column at hand.
    head: Vec<u32>,
    /// Rows of the column at hand.
    rows: Vec<u32>,
}

/// Neighbours in one row, each with its partner in the column.
#[derive(Clone, Copy)]
pub(crate) struct Pairs<'a> {
    all: &'a [Pair],
    next: u32,
}

impl Pairs<'_> {
    /// Begins of the `Y` of the row and of the column.
    #[inline(always)]
    pub fn next(&mut self) -> Option<(usize, usize)> {
        let own = self.all.get(self.next as usize)?;
        self.next = own.next;
        Some((own.row as usize, own.column as usize))
    }
}

impl Neighbours {
    /// Adds a neighbour of the block at hand.
    pub fn push(&mut self, neighbour: Neighbour) {
        self.all.push(neighbour);
    }

    /// Takes the neighbour of the block at hand away if it is the only one and so wide.
    pub fn take_single(&mut self, wide: usize) -> Option<Neighbour> {
        let first = self.ends.last().map_or(0, |&end| end as usize);
        match self.all[first..] {
            [only] if only.width as usize >= wide => self.all.pop(),
            _ => None,
        }
    }

    /// Ends the block at hand.
    pub fn close(&mut self) {
        self.ends.push(self.all.len() as u32);
    }

    /// Drops all.
    pub fn clear(&mut self) {
        self.all.clear();
        self.ends.clear();
    }

    /// Sorts the neighbours by their positions, of which there are so many.
    pub fn sort(&mut self, positions: usize) {
        self.start.clear();
        self.start.resize(positions + 1, 0);
        for own in &self.all {
            self.start[own.position as usize] += 1;
        }
        let mut sum = 0;
        for start in &mut self.start {
            sum += *start;
            *start = sum;
        }
        // From the last one on, so that every start ends up at the first.
        self.members.clear();
        self.members.resize(self.all.len(), (0, 0));
        for (block, &end) in self.ends.iter().enumerate().rev() {
            let first = block.checked_sub(1).map_or(0, |before| self.ends[before]);
            for k in (first..end).rev() {
                let place = &mut self.start[self.all[k as usize].position as usize];
                *place -= 1;
                self.members[*place as usize] = (k, end);
            }
        }
        self.head.resize(positions, NONE);
        self.pairs.resize(self.all.len(), Pair::default());
    }

    /// Pairs the neighbours in a column with those after them.
    pub fn pair(&mut self, column: usize) {
        let members = self.start[column] as usize..self.start[column + 1] as usize;
        // From the last one on: each goes before those that are there.
        for &(first, end) in self.members[members].iter().rev() {
            let own = &self.all[first as usize..end as usize];
            let pairs = &mut self.pairs[first as usize..end as usize];
            let column = own[0].at;
            for ((k, own), pair) in (first..end).zip(own).zip(pairs) {
                let head = &mut self.head[own.position as usize];
                if *head == NONE {
                    self.rows.push(own.position);
                }
                *pair = Pair {
                    row: own.at,
                    column,
                    next: *head,
                };
                *head = k;
            }
        }
    }

    /// Puts the rows of a column in ascending order, as their blocks lie: so the machine fetches them ahead.
    pub fn order_rows(&mut self, column: usize) {
        let positions = self.head.len();
        if self.rows.len() * FEW < positions - column {
            self.rows.sort_unstable_by(|a, b| b.cmp(a));
            return;
        }
        self.rows.clear();
        let paired = (column..positions)
            .rev()
            .filter(|&row| self.head[row] != NONE);
        self.rows.extend(paired.map(|row| row as u32));
    }

    /// The next row in which neighbours were paired: one of them for all, and the pairs.
    #[inline(always)]
    pub fn next_row(&mut self) -> Option<(Neighbour, Pairs<'_>)> {
        let row = self.rows.pop()?;
        let next = std::mem::replace(&mut self.head[row as usize], NONE);
        let all = &self.pairs[..];
        Some((self.all[next as usize], Pairs { all, next }))
    }
}
