//! Twins of `shaders/krishnamurthy_*.wgsl`: the same pass over three layouts.

use glam::Vec4;

use crate::batch::Batch;

/// Every line has a row of its own with its parameter and 2 (degree + 1) knots.
pub(crate) fn krishnamurthy_unpacked(batch: &Batch, knots: &[f32], first: Vec<f32>) -> Vec<f32> {
    let row = |line: usize| &knots[line * (2 * batch.width + 3)..];
    basis(batch, 1, first, |line| row(line)[0], |line, m| row(line)[1 + m])
}

/// Four lines share a row, one in each channel.
pub(crate) fn krishnamurthy_packed(batch: &Batch, knots: &[Vec4], first: Vec<f32>) -> Vec<f32> {
    let row = |line: usize| &knots[(line / 4) * (2 * batch.width + 3)..];
    basis(batch, 4, first, |line| row(line)[0][line % 4], |line, m| row(line)[1 + m][line % 4])
}

/// A line points into the knot vector that it shares with others.
pub(crate) fn krishnamurthy_indexed(batch: &Batch, knots: &[f32], first: Vec<f32>) -> Vec<f32> {
    let knot = |line: usize, m: usize| {
        let line = &batch.lines[line];
        knots[line.knots as usize + m.min(2 * line.degree as usize + 1)]
    };
    basis(batch, 1, first, |line| batch.lines[line].t, knot)
}

/// 0/0 is 0.
fn ratio(a: f32, b: f32) -> f32 {
    if b == 0.0 { 0.0 } else { a / b }
}

fn basis(
    batch: &Batch,
    lanes: usize,
    first: Vec<f32>,
    parameter: impl Fn(usize) -> f32,
    knot: impl Fn(usize, usize) -> f32,
) -> Vec<f32> {
    let (width, stride) = (batch.width, batch.width + 2);
    let rows = batch.lines.len().div_ceil(lanes);
    let mut basis = vec![0.0; rows * lanes * 3 * width];
    let mut before = first;
    for q in 0..width {
        let mut after = vec![0.0; before.len()];
        for (line, own_line) in batch.lines.iter().enumerate() {
            let p = own_line.degree as usize;
            // Element k of the line's row, in buffers of rows of `length` elements.
            let place = |length: usize, k: usize| ((line / lanes) * length + k) * lanes + line % lanes;
            let slope = |i: usize, q: usize, step: usize, own: f32, next: f32| {
                let left = ratio(own, knot(line, i + step) - knot(line, i));
                let right = ratio(next, knot(line, i + step + 1) - knot(line, i + 1));
                q as f32 * (left - right)
            };
            for i in 0..width {
                let [own, next, last] = [0, 1, 2].map(|k| before[place(stride, i + k)]);
                let t = parameter(line);
                let mut value = own;
                if q > 0 && q <= p {
                    let left = ratio(t - knot(line, i), knot(line, i + q) - knot(line, i));
                    let ahead = knot(line, i + q + 1);
                    value = left * own + ratio(ahead - t, ahead - knot(line, i + 1)) * next;
                }
                after[place(stride, i)] = value;
                if q == p {
                    basis[place(3 * width, i)] = value;
                    if q > 0 {
                        basis[place(3 * width, width + i)] = slope(i, p, q, own, next);
                    }
                }
                if q + 1 == p {
                    let (first, second) = (slope(i, q, q, own, next), slope(i + 1, q, q, next, last));
                    basis[place(3 * width, 2 * width + i)] = slope(i, p, q + 1, first, second);
                }
            }
        }
        before = after;
    }
    basis
}
