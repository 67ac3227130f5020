//! Recordings made ready to be cut: stamps on even clocks where they come in bursts, single spikes replaced, copies left out.

pub(super) mod clocks;

use std::borrow::Cow;

use findings::Findings;
use recording::Recording;
use recording::readings::without_spikes;

use self::clocks::{on_even_clocks, without_bursts};
use super::checks::without_copies;

/// Recordings of one device as the steps after this one take them, and what was done to them.
#[derive(Clone, Debug)]
pub struct Prepared<'a> {
    /// The recordings as they were read, without copies.
    pub originals: Vec<&'a Recording>,
    /// The same made ready.
    pub recordings: Vec<Cow<'a, Recording>>,
    /// What reading them said, and what was done.
    pub remarks: Findings,
}

impl<'a> Prepared<'a> {
    /// Makes recordings ready.
    pub fn of(recordings: impl IntoIterator<Item = &'a Recording>) -> Self {
        let (originals, copies) = without_copies(recordings);
        let mut prepared = Self {
            recordings: originals.iter().copied().map(Cow::Borrowed).collect(),
            originals,
            remarks: copies.into(),
        };
        let said = prepared.originals.iter().flat_map(|r| r.warnings.iter());
        prepared.remarks.extend(said.cloned());
        prepared.even_bursts();
        prepared.replace_spikes();
        prepared
    }

    /// Puts the gyroscope on an even clock where its stamps scatter about one.
    #[must_use]
    pub fn on_even_clocks(mut self) -> Self {
        for recording in &mut self.recordings {
            if let Some(evened) = on_even_clocks(recording) {
                *recording = Cow::Owned(evened);
            }
        }
        self
    }

    /// The recordings made ready.
    pub fn all(&self) -> Vec<&Recording> {
        self.recordings.iter().map(AsRef::as_ref).collect()
    }

    fn even_bursts(&mut self) {
        for recording in &mut self.recordings {
            if let Some((evened, found)) = without_bursts(recording) {
                *recording = Cow::Owned(evened);
                self.remarks.extend(found);
            }
        }
    }

    fn replace_spikes(&mut self) {
        for recording in &mut self.recordings {
            if let Some((clean, found)) = without_spikes(recording) {
                self.remarks
                    .extend(found.iter().map(|f| f.in_recording(&clean)));
                *recording = Cow::Owned(clean);
            }
        }
    }
}
