//! A list of findings that takes what becomes one.

use std::collections::HashSet;
use std::ops::Deref;

use serde::{Deserialize, Serialize};

use crate::finding::Finding;
use crate::kind::Kind;
use crate::level::Level;
use crate::words::Front;

/// Findings in the order in which they were made.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Findings(Vec<Finding>);

impl Findings {
    /// None yet.
    pub const fn new() -> Self {
        Self(Vec::new())
    }

    /// Adds one.
    pub fn push(&mut self, finding: impl Into<Finding>) {
        self.0.push(finding.into());
    }

    /// Adds one before the others.
    pub fn push_first(&mut self, finding: impl Into<Finding>) {
        self.0.insert(0, finding.into());
    }

    /// Adds several.
    pub fn extend<T: Into<Finding>>(&mut self, findings: impl IntoIterator<Item = T>) {
        self.0.extend(findings.into_iter().map(Into::into));
    }

    /// Takes those of another list.
    pub fn append(&mut self, other: &mut Self) {
        self.0.append(&mut other.0);
    }

    /// Keeps those that fulfil a condition.
    pub fn retain(&mut self, keep: impl FnMut(&Finding) -> bool) {
        self.0.retain(keep);
    }

    /// Says everything once: leaves out what has the same words as one before.
    pub fn once(&mut self) {
        let mut said = HashSet::new();
        self.0
            .retain(|finding| said.insert(finding.text(Front::Plain)));
    }

    /// Returns true if the list has a finding of this kind.
    pub fn has(&self, kind: Kind) -> bool {
        self.0.iter().any(|finding| finding.kind == kind)
    }

    /// Those that do not forbid the use of a result.
    pub fn warnings(&self) -> impl Iterator<Item = &Finding> {
        self.0.iter().filter(|finding| finding.level < Level::Bad)
    }

    /// Those that forbid the use of a result.
    pub fn gates(&self) -> impl Iterator<Item = &Finding> {
        self.0.iter().filter(|finding| finding.level >= Level::Bad)
    }

    /// Calls a recording by another name.
    pub fn rename(&mut self, old: &str, new: &str) {
        for finding in &mut self.0 {
            if finding.place.recording.as_deref() == Some(old) {
                finding.place.recording = Some(new.to_owned());
            }
            for detail in finding.details.iter_mut().filter(|d| d.name == "text") {
                if let Some(rest) = detail.value.strip_prefix(old) {
                    detail.value = format!("{new}{rest}");
                }
            }
        }
    }

    /// All in words.
    pub fn texts(&self, front: Front) -> Vec<String> {
        self.0.iter().map(|finding| finding.text(front)).collect()
    }
}

impl Deref for Findings {
    type Target = [Finding];

    fn deref(&self) -> &[Finding] {
        &self.0
    }
}

impl<T: Into<Finding>> FromIterator<T> for Findings {
    fn from_iter<I: IntoIterator<Item = T>>(findings: I) -> Self {
        Self(findings.into_iter().map(Into::into).collect())
    }
}

impl<T: Into<Finding>> From<Vec<T>> for Findings {
    fn from(findings: Vec<T>) -> Self {
        findings.into_iter().collect()
    }
}

impl IntoIterator for Findings {
    type Item = Finding;
    type IntoIter = std::vec::IntoIter<Finding>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

impl<'a> IntoIterator for &'a Findings {
    type Item = &'a Finding;
    type IntoIter = std::slice::Iter<'a, Finding>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

impl From<&Finding> for Finding {
    fn from(finding: &Finding) -> Self {
        finding.clone()
    }
}

impl Finding {
    /// The text of [`Kind::REMARK`], which has no entry of its own.
    pub fn own_text(&self) -> Option<&str> {
        self.word("text")
    }
}
