//! The slope triangles of a panel: which orders have one, and what it looks like.

use super::axes::Axes;
use super::canvas::{Canvas, Point, Stroke};
use super::curve::{Curve, Panel};
use super::place::{Stretch, place, points_along};
use super::style::{TEXT, color, letters};
use super::triangle::{LABEL_SIZE, Triangle};
use plotters::style::text_anchor::HPos;

/// Orders closer than this share a triangle.
const SAME_ORDER: f64 = 0.05;

/// One triangle for every distinct order, steepest first: those have the fewest places. None covers the
/// curves or the `obstacles`.
pub(super) fn draw(canvas: &mut Canvas<'_>, panel: &Panel, axes: &Axes, mut obstacles: Vec<Point>) {
    for curve in &panel.curves {
        for path in axes.unbroken(curve) {
            obstacles.extend(points_along(&path));
        }
        for (from, to) in axes.inside(&axes.path(&curve.bias)) {
            obstacles.extend(points_along(&[from, to]));
        }
    }
    let mut taken: Vec<Triangle> = Vec::new();
    for cluster in clusters(&panel.curves) {
        // One triangle stands for all curves of a cluster, with their mean order.
        let order = cluster.iter().map(|(_, order)| order).sum::<f64>() / cluster.len() as f64;
        let label = format!("{order:.2}");
        let paths: Vec<Vec<Point>> = cluster
            .iter()
            .map(|(curve, _)| {
                let fitted = curve.marks().filter(|mark| mark.fitted);
                fitted.map(|mark| axes.at((mark.x, mark.y))).collect()
            })
            .collect();
        let stretch = |path| Stretch {
            path,
            slope: order * axes.slope_of_order(),
            label: &label,
        };
        let stretches: Vec<Stretch<'_>> = paths.iter().map(|path| stretch(path)).collect();
        let Some(triangle) = place(&stretches, &axes.plot, &obstacles, &taken) else {
            continue;
        };
        let color = match cluster[..] {
            [(curve, _)] => color(curve.color),
            _ => TEXT,
        };
        draw_triangle(canvas, &triangle, &label, Stroke { color, width: 1.1 });
        taken.push(triangle);
    }
}

fn draw_triangle(canvas: &mut Canvas<'_>, triangle: &Triangle, label: &str, stroke: Stroke) {
    let [a, b, c] = triangle.corners;
    canvas.path(&[a, b, c, a], stroke);
    let y = f64::midpoint(triangle.label.top, triangle.label.bottom);
    let (at, anchor) = if triangle.label.right < c.0 {
        ((triangle.label.right, y), HPos::Right)
    } else {
        ((triangle.label.left, y), HPos::Left)
    };
    canvas.text(label, at, letters(LABEL_SIZE, false, anchor));
}

/// Curves with a slope, sorted into runs of neighbouring orders, the steepest first.
fn clusters(curves: &[Curve]) -> Vec<Vec<(&Curve, f64)>> {
    let mut sloped: Vec<(&Curve, f64)> = curves
        .iter()
        .filter_map(|curve| Some((curve, curve.slope?)))
        .collect();
    sloped.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
    let mut clusters: Vec<Vec<(&Curve, f64)>> = Vec::new();
    for (curve, order) in sloped {
        match clusters.last_mut() {
            Some(cluster) if cluster.iter().any(|c| (c.1 - order).abs() < SAME_ORDER) => {
                cluster.push((curve, order));
            }
            _ => clusters.push(vec![(curve, order)]),
        }
    }
    clusters
}
