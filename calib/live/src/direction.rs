//! Directions to place a device in.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Direction that points up, as signs of the device's axes: one axis for a face, two for an edge, three for a corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Direction {
    /// −1, 0 or 1 for each axis, not all 0.
    pub signs: [i8; 3],
}

impl Direction {
    /// The 6 faces, the 12 edges and the 8 corners, in this order.
    ///
    /// # Examples
    /// ```
    /// let all = stillpoint_live::Direction::all();
    /// assert_eq!(all.len(), 26);
    /// assert_eq!(all[0].signs, [0, 0, 1]);
    /// ```
    pub fn all() -> Vec<Self> {
        let signs = [1, -1, 0];
        let mut all = Vec::new();
        for z in signs {
            for y in signs {
                for x in signs {
                    all.push(Self { signs: [x, y, z] });
                }
            }
        }
        all.retain(|d| d.axes() > 0);
        all.sort_by_key(Self::axes);
        all
    }

    /// The number of axes that point up: 1, 2 or 3.
    pub fn axes(&self) -> usize {
        self.signs.iter().filter(|s| **s != 0).count()
    }

    /// Specific force in that placement, in units of gravity (3).
    pub fn unit(&self) -> Vector3<f64> {
        Vector3::from(self.signs.map(f64::from)).normalize()
    }

    /// The one of [`all`](Self::all) that is nearest to `up`.
    pub fn nearest(up: &Vector3<f64>) -> Self {
        let all = Self::all();
        let near = |d: &Self| d.unit().dot(up);
        let nearest = all.iter().max_by(|a, b| near(a).total_cmp(&near(b)));
        nearest.copied().unwrap_or(Self { signs: [0, 0, 1] })
    }
}
