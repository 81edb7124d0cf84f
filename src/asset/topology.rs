//! Strips, loops and fans to lists (glTF 2.0, section 3.7.2.1).

use super::Topology;

/// Primitive modes by their codes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mode {
    Points,
    Lines,
    LineLoop,
    LineStrip,
    Triangles,
    TriangleStrip,
    TriangleFan,
}

impl Mode {
    pub(super) fn from_code(code: u64) -> Option<Self> {
        const ALL: [Mode; 7] = [
            Mode::Points,
            Mode::Lines,
            Mode::LineLoop,
            Mode::LineStrip,
            Mode::Triangles,
            Mode::TriangleStrip,
            Mode::TriangleFan,
        ];
        ALL.get(usize::try_from(code).ok()?).copied()
    }

    pub(super) fn topology(self) -> Topology {
        match self {
            Self::Points => Topology::Points,
            Self::Lines | Self::LineLoop | Self::LineStrip => Topology::Lines,
            Self::Triangles | Self::TriangleStrip | Self::TriangleFan => Topology::Triangles,
        }
    }

    /// Entries that [`Self::unroll`] makes of `count` at most, for every entry.
    pub(super) fn growth(self) -> u64 {
        match self {
            Self::Points | Self::Lines | Self::Triangles => 1,
            Self::LineLoop | Self::LineStrip => 2,
            Self::TriangleStrip | Self::TriangleFan => 3,
        }
    }

    /// The list with the same lines or triangles, and how many entries at the end belong to none.
    pub(super) fn unroll(self, mut strip: Vec<u32>) -> (Vec<u32>, usize) {
        let whole = |strip: &mut Vec<u32>, size: usize| {
            let rest = strip.len() % size;
            strip.truncate(strip.len() - rest);
            rest
        };
        match self {
            Self::Points => (strip, 0),
            Self::Lines => {
                let rest = whole(&mut strip, 2);
                (strip, rest)
            }
            Self::Triangles => {
                let rest = whole(&mut strip, 3);
                (strip, rest)
            }
            Self::LineStrip | Self::LineLoop => {
                let close = if self == Self::LineLoop && strip.len() > 1 { strip.first().copied() } else { None };
                let close = close.zip(strip.last().copied()).map(|(first, last)| [last, first]);
                let rest = if strip.len() < 2 { strip.len() } else { 0 };
                let lines = strip.windows(2).map(|pair| [pair[0], pair[1]]);
                (lines.chain(close).flatten().collect(), rest)
            }
            Self::TriangleStrip | Self::TriangleFan => {
                let rest = if strip.len() < 3 { strip.len() } else { 0 };
                let first = strip.first().copied().unwrap_or_default();
                let triangle = |(i, v): (usize, &[u32])| match (self, i % 2) {
                    (Self::TriangleFan, _) => [v[1], v[2], first],
                    // Every second triangle of a strip turns the other way.
                    (_, 0) => [v[0], v[1], v[2]],
                    _ => [v[0], v[2], v[1]],
                };
                (strip.windows(3).enumerate().flat_map(triangle).collect(), rest)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unrolls_every_mode() {
        let v = || vec![10, 11, 12, 13, 14];
        for (code, topology, list, rest) in [
            (0, Topology::Points, vec![10, 11, 12, 13, 14], 0),
            (1, Topology::Lines, vec![10, 11, 12, 13], 1),
            (2, Topology::Lines, vec![10, 11, 11, 12, 12, 13, 13, 14, 14, 10], 0),
            (3, Topology::Lines, vec![10, 11, 11, 12, 12, 13, 13, 14], 0),
            (4, Topology::Triangles, vec![10, 11, 12], 2),
            (5, Topology::Triangles, vec![10, 11, 12, 11, 13, 12, 12, 13, 14], 0),
            (6, Topology::Triangles, vec![11, 12, 10, 12, 13, 10, 13, 14, 10], 0),
        ] {
            let mode = Mode::from_code(code).unwrap();
            assert_eq!((mode.topology(), mode.unroll(v())), (topology, (list, rest)), "{mode:?}");
            assert!(mode.unroll(vec![]).0.is_empty());
            assert!(mode.unroll(v()).0.len() as u64 <= 5 * mode.growth());
        }
        assert_eq!(Mode::LineLoop.unroll(vec![3]), (vec![], 1));
        assert_eq!(Mode::TriangleFan.unroll(vec![3, 4]), (vec![], 2));
        assert_eq!(Mode::from_code(7), None);
        assert_eq!(Mode::from_code(u64::MAX), None);
    }
}
