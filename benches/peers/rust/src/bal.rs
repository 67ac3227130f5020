//! Bundle adjustment files.

/// Cameras, points, and what was seen: camera, point, place in pixels.
pub struct Bundle {
    pub cameras: Vec<[f64; 9]>,
    pub points: Vec<[f64; 3]>,
    pub seen: Vec<(usize, usize, [f64; 2])>,
}

/// Reads a file.
pub fn read(file: &str) -> Result<Bundle, Box<dyn std::error::Error>> {
    let text = std::fs::read_to_string(file)?;
    let mut words = text.split_whitespace().map(str::parse::<f64>);
    let mut next = || {
        words
            .next()
            .ok_or("the file ends early")?
            .map_err(|_| "no number")
    };
    let (cameras, points, seen) = (next()? as usize, next()? as usize, next()? as usize);
    let mut bundle = Bundle {
        cameras: vec![[0.0; 9]; cameras],
        points: vec![[0.0; 3]; points],
        seen: Vec::with_capacity(seen),
    };
    for _ in 0..seen {
        let (camera, point) = (next()? as usize, next()? as usize);
        bundle.seen.push((camera, point, [next()?, next()?]));
    }
    let numbers = bundle.cameras.as_flattened_mut().iter_mut();
    for number in numbers.chain(bundle.points.as_flattened_mut()) {
        *number = next()?;
    }
    Ok(bundle)
}
