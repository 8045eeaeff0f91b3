//! A few unknowns by least squares.

/// Over the columns that are used; the others are 0. `None` where they do not tell all of these.
pub(super) fn solve<T, const N: usize>(
    rows: &[T],
    used: [bool; N],
    columns: &dyn Fn(&T) -> [f64; N],
    right: &dyn Fn(&T) -> f64,
) -> Option<[f64; N]> {
    let at: Vec<usize> = (0..N).filter(|k| used[*k]).collect();
    let size = at.len();
    let mut matrix = vec![vec![0.0; size + 1]; size];
    for row in rows {
        let (of, y) = (columns(row), right(row));
        for (i, from) in at.iter().enumerate() {
            for (j, to) in at.iter().enumerate() {
                matrix[i][j] += of[*from] * of[*to];
            }
            matrix[i][size] += of[*from] * y;
        }
    }
    for i in 0..size {
        let pivot = (i..size).max_by(|u, v| matrix[*u][i].abs().total_cmp(&matrix[*v][i].abs()))?;
        matrix.swap(i, pivot);
        let scale = matrix[i][i];
        // Columns that say the same leave nothing to tell them by.
        if scale.abs() <= SINGULAR || scale.is_nan() {
            return None;
        }
        matrix[i].iter_mut().for_each(|x| *x /= scale);
        let own = matrix[i].clone();
        for (k, row) in matrix.iter_mut().enumerate() {
            let by = row[i];
            if k != i {
                row.iter_mut().zip(&own).for_each(|(x, own)| *x -= by * own);
            }
        }
    }
    let mut solution = [0.0; N];
    for (i, k) in at.iter().enumerate() {
        solution[*k] = matrix[i][size];
    }
    Some(solution)
}

/// A pivot under this is none.
const SINGULAR: f64 = 1e-9;
