//! Strips, loops and fans to lists (glTF 2.0, section 3.7.2.1).

use super::Topology;
use ::gltf::json::mesh::Mode;

/// What the unrolled list of a mode means.
pub(super) fn of(mode: Mode) -> Topology {
    match mode {
        Mode::Points => Topology::Points,
        Mode::Lines | Mode::LineLoop | Mode::LineStrip => Topology::Lines,
        Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan => Topology::Triangles,
    }
}

/// Entries that [`unroll`] makes of `count` at most, for every entry.
pub(super) fn growth(mode: Mode) -> u64 {
    match mode {
        Mode::Points | Mode::Lines | Mode::Triangles => 1,
        Mode::LineLoop | Mode::LineStrip => 2,
        Mode::TriangleStrip | Mode::TriangleFan => 3,
    }
}

/// The list with the same lines or triangles, and how many entries at the end belong to none.
pub(super) fn unroll(mode: Mode, mut strip: Vec<u32>) -> (Vec<u32>, usize) {
    let whole = |strip: &mut Vec<u32>, size: usize| {
        let rest = strip.len() % size;
        strip.truncate(strip.len() - rest);
        rest
    };
    match mode {
        Mode::Points => (strip, 0),
        Mode::Lines => {
            let rest = whole(&mut strip, 2);
            (strip, rest)
        }
        Mode::Triangles => {
            let rest = whole(&mut strip, 3);
            (strip, rest)
        }
        Mode::LineStrip | Mode::LineLoop => {
            let close = if mode == Mode::LineLoop && strip.len() > 1 { strip.first().copied() } else { None };
            let close = close.zip(strip.last().copied()).map(|(first, last)| [last, first]);
            let rest = if strip.len() < 2 { strip.len() } else { 0 };
            let lines = strip.windows(2).map(|pair| [pair[0], pair[1]]);
            (lines.chain(close).flatten().collect(), rest)
        }
        Mode::TriangleStrip | Mode::TriangleFan => {
            let rest = if strip.len() < 3 { strip.len() } else { 0 };
            let first = strip.first().copied().unwrap_or_default();
            let triangle = |(i, v): (usize, &[u32])| match (mode, i % 2) {
                (Mode::TriangleFan, _) => [v[1], v[2], first],
                // Every second triangle of a strip turns the other way.
                (_, 0) => [v[0], v[1], v[2]],
                _ => [v[0], v[2], v[1]],
            };
            (strip.windows(3).enumerate().flat_map(triangle).collect(), rest)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unrolls_every_mode() {
        let v = || vec![10, 11, 12, 13, 14];
        for (mode, topology, list, rest) in [
            (Mode::Points, Topology::Points, vec![10, 11, 12, 13, 14], 0),
            (Mode::Lines, Topology::Lines, vec![10, 11, 12, 13], 1),
            (Mode::LineLoop, Topology::Lines, vec![10, 11, 11, 12, 12, 13, 13, 14, 14, 10], 0),
            (Mode::LineStrip, Topology::Lines, vec![10, 11, 11, 12, 12, 13, 13, 14], 0),
            (Mode::Triangles, Topology::Triangles, vec![10, 11, 12], 2),
            (Mode::TriangleStrip, Topology::Triangles, vec![10, 11, 12, 11, 13, 12, 12, 13, 14], 0),
            (Mode::TriangleFan, Topology::Triangles, vec![11, 12, 10, 12, 13, 10, 13, 14, 10], 0),
        ] {
            assert_eq!((of(mode), unroll(mode, v())), (topology, (list, rest)), "{mode:?}");
            assert!(unroll(mode, vec![]).0.is_empty());
            assert!(unroll(mode, v()).0.len() as u64 <= 5 * growth(mode));
        }
        assert_eq!(unroll(Mode::LineLoop, vec![3]), (vec![], 1));
        assert_eq!(unroll(Mode::TriangleFan, vec![3, 4]), (vec![], 2));
    }
}
