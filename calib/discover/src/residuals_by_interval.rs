//! Residuals of the models in every static interval and turn, for a plot.

use crate::discovery::Discovery;
use crate::gap::channel::Channel;
use crate::pictures::{Point, left, points, residuals};

/// Residuals of one channel.
#[derive(Clone, Debug)]
pub struct ChannelResiduals {
    /// The channel.
    pub channel: Channel,
    /// Its points, with the static interval of each, or the one before the turn, counted from 1 over all recordings.
    pub points: Vec<(usize, Point)>,
}

/// Computes the residuals of the base models and the final model in every channel, whatever the verdict.
pub fn residuals_by_interval(discovery: &Discovery) -> Vec<ChannelResiduals> {
    let (base, last) = (&discovery.search.base, &discovery.search.last);
    let noise = last.noise;
    let [before, after] = [base, last].map(|state| left(state, noise, residuals(state)));
    let nothing = 0.0 * &after;
    let rows = [before, after, nothing];
    let data = &last.fit.data;
    let interval = |channel, point: &Point| match channel {
        Channel::Direction => data.turns[point.place].from + 1,
        _ => data.chunks[point.place].rest + 1,
    };
    let of = |channel| {
        let points = points(last, &rows, channel).into_iter();
        ChannelResiduals {
            channel,
            points: points
                .map(|point| (interval(channel, &point), point))
                .collect(),
        }
    };
    let all = Channel::ALL.map(of).into_iter();
    all.filter(|left| !left.points.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use super::*;
    use crate::{Request, discover};

    #[test]
    fn a_device_that_lacks_nothing_leaves_its_noise_in_every_channel() {
        let session = Spec::hand_held(5).run().unwrap();
        let request = Request::new(session.truth.spec.gravity);
        let discovery = discover(&[session.recording], &request).unwrap();
        assert!(discovery.findings.effects.is_empty());
        let all = residuals_by_interval(&discovery);
        assert_eq!(all.len(), 3);
        for left in all {
            let squares = left.points.iter().map(|(_, p)| (p.after / p.std).powi(2));
            let mean = squares.sum::<f64>() / left.points.len() as f64;
            // What the parameters take makes it less than 1; what the walk adds, more.
            assert!(mean > 0.2 && mean < 3.0, "{:?} {mean}", left.channel);
        }
    }
}
