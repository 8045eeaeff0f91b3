//! Three unknowns by least squares.

/// Least squares over the columns that are used; the others are 0.
pub(super) fn solve<T>(
    rows: &[T],
    used: [bool; 3],
    columns: &dyn Fn(&T) -> [f64; 3],
    right: &dyn Fn(&T) -> f64,
) -> Option<[f64; 3]> {
    let at: Vec<usize> = (0..3).filter(|k| used[*k]).collect();
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
        if !(scale.abs() > 1e-9) {
            return None;
        }
        for j in i..=size {
            matrix[i][j] /= scale;
        }
        for k in 0..size {
            let by = matrix[k][i];
            if k != i {
                for j in i..=size {
                    matrix[k][j] -= by * matrix[i][j];
                }
            }
        }
    }
    let mut solution = [0.0; 3];
    for (i, k) in at.iter().enumerate() {
        solution[*k] = matrix[i][size];
    }
    Some(solution)
}
