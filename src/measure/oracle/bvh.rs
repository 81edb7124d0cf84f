//! A tree of boxes over everything that a ray may meet.

use super::ray::Ray;
use glam::DVec3;

/// An axis-aligned box, metres.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    low: DVec3,
    high: DVec3,
}

impl Bounds {
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        let empty = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };
        points.into_iter().fold(empty, |all, point| Self { low: all.low.min(point), high: all.high.max(point) })
    }

    fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Where a ray enters, if it does so between its origin and `limit_m`.
    fn entry(&self, ray: &Ray, inverse_direction: DVec3, limit_m: f64) -> Option<f64> {
        let (a, b) = ((self.low - ray.origin) * inverse_direction, (self.high - ray.origin) * inverse_direction);
        // f64::min and max drop the NaN of a ray within a face's plane. A little slack covers rounding.
        let near = a.min(b).to_array().into_iter().fold(0.0, f64::max) * (1.0 - 1e-12);
        let far = a.max(b).to_array().into_iter().fold(limit_m, f64::min) * (1.0 + 1e-12);
        (near <= far).then_some(near)
    }
}

/// Items of one leaf.
const LEAF_ITEMS: usize = 2;

enum Node {
    Leaf {
        first: usize,
        end: usize,
    },
    /// The left child follows its parent.
    Fork {
        right: usize,
    },
}

/// The tree; items are indices of the list that it was made from.
pub struct Bvh {
    nodes: Vec<(Bounds, Node)>,
    items: Vec<usize>,
}

impl Bvh {
    pub fn new(bounds: &[Bounds]) -> Self {
        let mut tree = Self { nodes: Vec::new(), items: (0..bounds.len()).collect() };
        if !bounds.is_empty() {
            tree.split(bounds, 0, bounds.len());
        }
        tree
    }

    fn split(&mut self, bounds: &[Bounds], first: usize, end: usize) {
        let items = &mut self.items[first..end];
        let all = items.iter().map(|&item| bounds[item]).reduce(Bounds::union);
        let all = all.unwrap_or(Bounds::around([]));
        let node = self.nodes.len();
        self.nodes.push((all, Node::Leaf { first, end }));
        if end - first <= LEAF_ITEMS {
            return;
        }
        // At the median of the middles along their widest axis: never deeper than the logarithm.
        let middle = |item: usize| bounds[item].low + bounds[item].high;
        let spread = Bounds::around(items.iter().map(|&item| middle(item)));
        let axis = (spread.high - spread.low).max_position();
        let half = items.len() / 2;
        items.select_nth_unstable_by(half, |&a, &b| middle(a)[axis].total_cmp(&middle(b)[axis]));
        self.split(bounds, first, first + half);
        self.nodes[node].1 = Node::Fork { right: self.nodes.len() };
        self.split(bounds, first + half, end);
    }

    /// Visits the items whose boxes the ray enters before `limit_m`, nearer boxes first; `visit` gives the new limit.
    pub fn walk(&self, ray: &Ray, mut limit_m: f64, mut visit: impl FnMut(usize, f64) -> f64) {
        let inverse = ray.direction.recip();
        let entry = |node: usize, limit_m| self.nodes[node].0.entry(ray, inverse, limit_m);
        let mut open: Vec<(usize, f64)> = Vec::with_capacity(64);
        if !self.nodes.is_empty() {
            open.extend(entry(0, limit_m).map(|near| (0, near)));
        }
        while let Some((node, near)) = open.pop() {
            if near > limit_m {
                continue;
            }
            match self.nodes[node].1 {
                Node::Leaf { first, end } => {
                    for &item in &self.items[first..end] {
                        limit_m = visit(item, limit_m);
                    }
                }
                Node::Fork { right } => {
                    let mut children = [node + 1, right].map(|child| entry(child, limit_m).map(|near| (child, near)));
                    if let [Some((_, left)), Some((_, right))] = children
                        && left < right
                    {
                        children.reverse();
                    }
                    open.extend(children.into_iter().flatten());
                }
            }
        }
    }
}
