//! What is left of a window whose graphics device is lost.

use std::path::PathBuf;
use std::str::FromStr;

use glam::DVec3;
use trimloop_gpu::Gpu;
use trimloop_render::{Direction, Up};

use crate::navigation::Navigation;

/// Where a window was that has lost its graphics device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resume {
    /// From where the model was seen, if it ever was.
    pub view: Option<Navigation>,
    /// How often that has happened.
    pub losses: u32,
}

/// What a window shows, kept up to date for the case that its device is lost.
#[derive(Clone, Debug, Default)]
pub(crate) struct State {
    pub gpu: Option<Gpu>,
    pub files: Vec<PathBuf>,
    pub view: Option<Navigation>,
}

impl State {
    pub fn is_lost(&self) -> bool {
        let Some(gpu) = &self.gpu else { return false };
        // The loss is told when somebody asks.
        let _ = gpu.device().poll(wgpu::PollType::Poll);
        gpu.is_lost()
    }
}

/// Numbers with commas between them: how often; and where there is a view the target, the distance, the direction, 1 for
/// parallel.
impl std::fmt::Display for Resume {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Some(view) = self.view else { return write!(f, "{}", self.losses) };
        let Navigation { target, distance_mm, direction, is_parallel, .. } = view;
        let Direction { azimuth_deg, elevation_deg } = direction;
        let [x, y, z] = target.to_array();
        let flag = u8::from(is_parallel);
        write!(f, "{},{x},{y},{z},{distance_mm},{azimuth_deg},{elevation_deg},{flag}", self.losses)
    }
}

/// What is no view.
#[derive(Debug, thiserror::Error)]
#[error("one number is needed, or eight with commas between them")]
pub struct NoView;

impl FromStr for Resume {
    type Err = NoView;

    fn from_str(text: &str) -> Result<Self, NoView> {
        if let Ok(losses) = text.parse() {
            return Ok(Self { view: None, losses });
        }
        let numbers: Result<Vec<f64>, _> = text.split(',').map(str::parse).collect();
        let Ok([losses, x, y, z, distance_mm, azimuth_deg, elevation_deg, flag]) =
            <[f64; 8]>::try_from(numbers.map_err(|_| NoView)?)
        else {
            return Err(NoView);
        };
        let is_sound =
            [losses, x, y, z, distance_mm, azimuth_deg, elevation_deg].iter().all(|n| n.is_finite());
        if !is_sound || distance_mm <= 0.0 {
            return Err(NoView);
        }
        let view = Navigation {
            target: DVec3::new(x, y, z),
            distance_mm,
            direction: Direction { azimuth_deg, elevation_deg },
            is_parallel: flag == 1.0,
            ..Navigation::new(Up::Z)
        };
        Ok(Self { view: Some(view), losses: losses as u32 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_view_survives_as_text() {
        let view = Navigation {
            target: DVec3::new(-0.1, 1e-7, 12345.678),
            distance_mm: 0.3,
            is_parallel: true,
            ..Navigation::new(Up::Z)
        };
        for view in [None, Some(view)] {
            let resume = Resume { view, losses: 2 };
            assert_eq!(resume.to_string().parse::<Resume>().expect("a view"), resume);
        }
        for text in ["", "1,2,3", "a,b,c,d,e,f,g,h", "0,0,0,0,-1,0,0,0", "0,nan,0,0,1,0,0,0"] {
            assert!(text.parse::<Resume>().is_err(), "{text}");
        }
    }
}
