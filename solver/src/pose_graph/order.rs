//! Connected parts of poses, those of them that are held, and a start by the edges one after the other.

/// Sets of poses that edges connect.
struct Parts(Vec<u32>);

impl Parts {
    fn of(count: usize, ends: impl Iterator<Item = (u32, u32)>) -> Self {
        let mut parts = Self((0..count as u32).collect());
        for (a, b) in ends {
            let (a, b) = (parts.first(a), parts.first(b));
            parts.0[a.max(b) as usize] = a.min(b);
        }
        parts
    }

    /// The first pose of a part.
    fn first(&mut self, mut pose: u32) -> u32 {
        while self.0[pose as usize] != pose {
            let above = self.0[self.0[pose as usize] as usize];
            self.0[pose as usize] = above;
            pose = above;
        }
        pose
    }
}

/// The poses that are held: the given ones, and of every part that has none the first.
pub(super) fn anchors(
    count: usize,
    ends: impl Iterator<Item = (u32, u32)>,
    held: &[u32],
) -> Vec<u32> {
    let mut parts = Parts::of(count, ends);
    let mut all: Vec<u32> = held.to_vec();
    let mut has = vec![false; count];
    for &pose in held {
        has[parts.first(pose) as usize] = true;
    }
    for pose in 0..count as u32 {
        if parts.first(pose) == pose && !has[pose as usize] {
            all.push(pose);
        }
    }
    all
}

/// Poses that no line of the file gives, by the edges from poses that are known: breadth first. `follow(known, edge, forward)`
/// is the pose at the other end.
pub(super) fn chained<P: Copy, E>(
    known: &mut [Option<P>],
    edges: &[(u32, u32, E)],
    origin: P,
    follow: impl Fn(&P, &E, bool) -> P,
) -> Vec<P> {
    let mut at: Vec<Vec<u32>> = vec![Vec::new(); known.len()];
    for (k, (a, b, _)) in edges.iter().enumerate() {
        at[*a as usize].push(k as u32);
        at[*b as usize].push(k as u32);
    }
    let mut open: std::collections::VecDeque<u32> = (0..known.len() as u32)
        .filter(|&pose| known[pose as usize].is_some())
        .collect();
    let mut next = 0;
    loop {
        while let Some(pose) = open.pop_front() {
            let Some(here) = known[pose as usize] else {
                continue;
            };
            for &k in &at[pose as usize] {
                let (a, b, edge) = &edges[k as usize];
                let (other, forward) = if *a == pose { (*b, true) } else { (*a, false) };
                if known[other as usize].is_none() {
                    known[other as usize] = Some(follow(&here, edge, forward));
                    open.push_back(other);
                }
            }
        }
        // Another part, of which nothing is known.
        while next < known.len() && known[next].is_some() {
            next += 1;
        }
        if next == known.len() {
            break;
        }
        known[next] = Some(origin);
        open.push_back(next as u32);
    }
    known.iter().map(|pose| pose.unwrap_or(origin)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_has_something_that_is_held() {
        let ends = [(1, 0), (2, 3), (3, 4)];
        assert_eq!(anchors(6, ends.into_iter(), &[]), [0, 2, 5]);
        assert_eq!(anchors(6, ends.into_iter(), &[4]), [4, 0, 5]);
    }

    #[test]
    fn missing_poses_follow_the_edges_either_way() {
        let edges = [(0, 2, 5), (1, 2, 1)];
        let mut known = vec![Some(1), None, None, None];
        let follow = |p: &i32, e: &i32, forward| if forward { p + e } else { p - e };
        assert_eq!(chained(&mut known, &edges, 0, follow), [1, 5, 6, 0]);
    }
}
