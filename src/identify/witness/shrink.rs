//! A ray made smaller as long as it shows a good part of what it showed.

use super::super::ray::Emission;
use super::doubt::{Doubt, Limits, Shown};
use super::shape::Shape;
use super::small::{Nodes, placed};

/// What is left of a difference is a good part of it.
const GOOD: f64 = 0.1;
/// And this is enough of any.
const ENOUGH: f64 = 1e-2;
/// Numbers tried in the place of others, simplest first.
const ROUND: [f64; 9] = [0.0, 1.0, 2.0, 0.5, 5.0, 10.0, 0.1, 20.0, 0.01];
/// Rounds after which nothing is expected to get smaller any more.
const ROUNDS: usize = 4;

/// Of rays of more segments single ones are not tried: each would cost as many questions.
const LONG: usize = 16;
/// Of such a ray no parts are left out that are less than this part of it.
const PARTS: usize = 8;

/// A ray on its way.
struct Shrinking<'d> {
    doubt: &'d mut dyn Doubt,
    limits: Limits,
    shape: Shape,
    shown: Shown,
    /// The least part that a difference has to be.
    least: f64,
    /// Where a segment has its one value; all nodes have values of their own where it has several.
    nodes: Nodes,
}

/// The smallest ray on the way down from this one.
pub(super) fn shrink(
    doubt: &mut dyn Doubt,
    shape: Shape,
    shown: Shown,
    limits: Limits,
    nodes: Nodes,
) -> (Shape, Shown) {
    let mut at = Shrinking {
        least: (GOOD * shown.part).min(ENOUGH),
        doubt,
        limits,
        shape,
        shown,
        nodes,
    };
    at.drop_channels();
    at.flatten();
    for _ in 0..ROUNDS {
        let before = at.shape.clone();
        at.drop_segments();
        at.round_off();
        if at.shape == before || at.doubt.is_spent() {
            break;
        }
    }
    (at.shape, at.shown)
}

impl Shrinking<'_> {
    /// Goes on with another ray where that shows enough.
    fn take(&mut self, shape: Shape) -> bool {
        let fits = shape.count().is_multiple_of(self.limits.multiple);
        if !fits || shape == self.shape || self.doubt.is_spent() {
            return false;
        }
        match self.doubt.of(&shape.ray()) {
            Some(shown) if shown.part >= self.least => {
                (self.shape, self.shown) = (shape, shown);
                true
            }
            _ => false,
        }
    }

    /// The channel that differs alone, or at least no other that need not be there.
    fn drop_channels(&mut self) {
        let one = self.shape.only(self.shown.channel);
        if one.is_some_and(|one| self.take(one)) {
            return;
        }
        for channel in (0..self.shape.emission.len()).rev() {
            if self.shape.emission.len() > 1 {
                let fewer = self.shape.without_channel(channel);
                self.take(fewer);
            }
        }
    }

    /// One value a segment; where that shows nothing, every node goes on with its own.
    fn flatten(&mut self) {
        let nodes = self.placing();
        let flat = |of: &Emission| placed(nodes, &sampled(nodes, of));
        let shape = Shape {
            extinction: flat(&self.shape.extinction),
            emission: self.shape.emission.iter().map(flat).collect(),
            ..self.shape.clone()
        };
        if shape != self.shape && !self.take(shape) {
            self.nodes = Nodes::All;
        }
    }

    /// Halves, quarters … single segments are left out, from the back, where one that is shorter need not be kept.
    fn drop_segments(&mut self) {
        if self.shape.last < 1.0 {
            self.take(Shape {
                last: 1.0,
                ..self.shape.clone()
            });
        }
        if self.shape.count() > LONG {
            self.shorten(|shape, count| shape.without(0, shape.count() - count));
            self.shorten(|shape, count| shape.without(count, shape.count()));
        }
        let count = self.shape.count();
        let least = if count > LONG { count / PARTS } else { 1 };
        let mut size = count / 2;
        while size >= least.max(1) {
            let mut end = self.shape.count();
            while end >= size && self.shape.count() > size {
                let fewer = self.shape.without(end - size, end);
                if fewer.is_some_and(|fewer| self.take(fewer)) {
                    end = end.min(self.shape.count());
                } else {
                    end -= size;
                }
                if self.doubt.is_spent() {
                    return;
                }
            }
            size /= 2;
        }
    }

    /// The fewest segments at one end that show it, by bisection.
    fn shorten(&mut self, kept: impl Fn(&Shape, usize) -> Option<Shape>) {
        let whole = self.shape.clone();
        let (mut low, mut high) = (0, whole.count());
        while high - low > 1 && !self.doubt.is_spent() {
            let count = usize::midpoint(low, high).next_multiple_of(self.limits.multiple);
            if count >= high {
                break;
            }
            if kept(&whole, count).is_some_and(|fewer| self.take(fewer)) {
                high = count;
            } else {
                low = count;
            }
        }
    }

    fn round_off(&mut self) {
        for step in [1.0, 0.5, 0.1] {
            if (self.shape.step - step).abs() > 0.0 && rank(step) < rank(self.shape.step) {
                // The same optical depths, or the same extinctions.
                let ratio = self.shape.step / step;
                let mut scaled = self.shape.clone();
                scaled.step = step;
                let unscaled = scaled.clone();
                for tau in values(&mut scaled.extinction) {
                    *tau *= ratio;
                }
                if self.take(scaled) || self.take(unscaled) {
                    break;
                }
            }
        }
        if self.shape.last < 1.0 && rank(0.5) < rank(self.shape.last) {
            self.take(Shape {
                last: 0.5,
                ..self.shape.clone()
            });
        }
        self.numbers(&|shape| Some(&mut shape.extinction));
        self.light_one();
        for channel in 0..self.shape.emission.len() {
            self.numbers(&|shape| shape.emission.get_mut(channel));
        }
    }

    /// Of a long ray only one segment shines: at an end or beside it, or where half by half is left dark.
    fn light_one(&mut self) {
        let n = self.shape.count();
        if n <= LONG || self.is_lit_once() {
            return;
        }
        if [0, n - 1, 1, n - 2]
            .into_iter()
            .any(|i| self.light(i, i + 1))
        {
            return;
        }
        let (mut start, mut end) = (0, n);
        while end - start > 1 && !self.doubt.is_spent() {
            let middle = usize::midpoint(start, end);
            if self.light(start, middle) {
                end = middle;
            } else if self.light(middle, end) {
                start = middle;
            } else {
                return;
            }
        }
    }

    /// Whether all channels shine in one segment, or in none.
    fn is_lit_once(&self) -> bool {
        self.shape.emission.iter().all(|channel| {
            let values = sampled(self.placing(), channel);
            values.iter().filter(|c| c.abs() > 0.0).count() <= 1
        })
    }

    /// Only segments from `start` to `end` shine.
    fn light(&mut self, start: usize, end: usize) -> bool {
        let row = |i: usize| if (start..end).contains(&i) { 1.0 } else { 0.0 };
        let row: Vec<f64> = (0..self.shape.count()).map(row).collect();
        let emission = vec![placed(self.placing(), &row)];
        self.take(Shape {
            emission,
            ..self.shape.clone()
        })
    }

    /// Where a segment has its one value, if it is to have one.
    fn placing(&self) -> Nodes {
        match self.nodes {
            Nodes::All => Nodes::Middle,
            one => one,
        }
    }

    /// Numbers of one kind: all at once, then one by one.
    fn numbers(&mut self, of: &dyn Fn(&mut Shape) -> Option<&mut Emission>) {
        let row = |shape: &Shape| of(&mut shape.clone()).map(|row| row.clone());
        for value in [1.0, 0.0, 0.1, 0.01] {
            let Some(mut now) = row(&self.shape) else {
                return;
            };
            if values(&mut now).any(|x| rank(value) < rank(*x)) {
                values(&mut now).for_each(|x| *x = value);
                self.put(of, now);
            }
        }
        let n = self.shape.count();
        if n > LONG {
            return;
        }
        let count = if self.nodes == Nodes::All {
            2 * n + 1
        } else {
            n
        };
        for i in 0..count {
            let Some(now) = row(&self.shape) else { return };
            let all = listed(self.nodes, &now);
            let Some(first) = all.get(i).copied() else {
                return;
            };
            let few = [1, 2].map(|digits| format!("{first:.*e}", digits - 1).parse().ok());
            let candidates = ROUND.into_iter().chain(few.into_iter().flatten());
            for value in candidates.filter(|value: &f64| rank(*value) < rank(first)) {
                let mut next = all.clone();
                next[i] = value;
                if self.put(of, unlisted(self.nodes, &next, n)) {
                    break;
                }
            }
        }
    }

    /// Goes on with another row where that shows enough.
    fn put(&mut self, of: &dyn Fn(&mut Shape) -> Option<&mut Emission>, row: Emission) -> bool {
        let mut next = self.shape.clone();
        if let Some(old) = of(&mut next) {
            *old = row;
        }
        self.take(next)
    }
}

/// The value of each segment.
fn sampled(nodes: Nodes, of: &Emission) -> Vec<f64> {
    match nodes {
        Nodes::Front => of.edges[..of.middles.len()].to_vec(),
        Nodes::Back => of.edges[1..].to_vec(),
        Nodes::Middle | Nodes::All => of.middles.clone(),
    }
}

/// The numbers that may be chosen.
fn listed(nodes: Nodes, of: &Emission) -> Vec<f64> {
    match nodes {
        Nodes::All => [&of.edges[..], &of.middles[..]].concat(),
        one => sampled(one, of),
    }
}

/// And back.
fn unlisted(nodes: Nodes, values: &[f64], n: usize) -> Emission {
    match nodes {
        Nodes::All => {
            let (edges, middles) = values.split_at(n + 1);
            Emission {
                edges: edges.to_vec(),
                middles: middles.to_vec(),
            }
        }
        one => placed(one, values),
    }
}

/// Ends, then middles.
fn values(of: &mut Emission) -> impl Iterator<Item = &mut f64> {
    of.edges.iter_mut().chain(&mut of.middles)
}

/// How round a number is: its place among round ones, then its digits.
fn rank(x: f64) -> usize {
    let same = |round: &f64| (x - round).abs() <= 0.0;
    match ROUND.iter().position(same) {
        Some(place) => place,
        None => ROUND.len() + format!("{x:e}").len(),
    }
}
