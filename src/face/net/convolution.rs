//! Convolutions, full and depthwise, and maximum pooling.
//!
//! Pixels lie row by row, their channels together. A sum begins with the bias and adds the products of a window row by
//! row, pixel by pixel, channel by channel: in this order on every processor, so that all give the same bits. Vector
//! instructions work on different output channels, never within one sum.

/// Height, width and channels of a tensor.
pub(super) type Hwc = [usize; 3];

/// Output channels that are computed together.
const LANES: usize = 8;
/// Output pixels that are computed together.
const ROWS: usize = 4;

/// The window of a convolution or a pooling over its input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Window {
    /// Height and width of the window.
    pub size: [usize; 2],
    /// Rows and columns from one window to the next.
    pub stride: [usize; 2],
    /// Rows and columns of the first window that lie outside the input.
    pub before: [usize; 2],
}

impl Window {
    /// The offset into the input of a window's row or column, where that lies in it.
    #[inline]
    fn inside(&self, axis: usize, output: usize, offset: usize, length: usize) -> Option<usize> {
        (output * self.stride[axis] + offset).checked_sub(self.before[axis]).filter(|at| *at < length)
    }
}

/// What follows the sum, channel by channel.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Activation {
    /// Nothing.
    None,
    /// max(x, 0).
    Relu,
    /// x between 0 and 6.
    Relu6,
    /// x, and x times the channel's slope where it is negative.
    Prelu(Vec<f32>),
}

impl Activation {
    /// Applies it to the channels of pixels, the first of which is channel `first`.
    #[inline]
    pub(super) fn apply(&self, values: &mut [f32], first: usize) {
        match self {
            Self::None => {}
            Self::Relu => values.iter_mut().for_each(|v| *v = v.max(0.0)),
            Self::Relu6 => values.iter_mut().for_each(|v| *v = v.clamp(0.0, 6.0)),
            Self::Prelu(slopes) => {
                for (value, slope) in values.iter_mut().zip(&slopes[first..]) {
                    *value = value.max(0.0) + slope * value.min(0.0);
                }
            }
        }
    }
}

/// A convolution whose every output channel sees all input channels.
#[derive(Debug, Clone)]
pub(super) struct Convolution {
    pub input: Hwc,
    pub output: Hwc,
    pub window: Window,
    pub activation: Activation,
    /// Panels of [`LANES`] output channels: for each value of a window the weights of the panel's channels.
    panels: Vec<[f32; LANES]>,
    /// The bias, filled up to whole panels.
    bias: Vec<[f32; LANES]>,
}

impl Convolution {
    /// `weights` by output channel, row, column and input channel. All lengths must fit the shapes.
    pub(super) fn new(input: Hwc, output: Hwc, window: Window, weights: &[f32], bias: &[f32]) -> Self {
        let length = window.size[0] * window.size[1] * input[2];
        let channels = output[2];
        let mut panels = Vec::with_capacity(channels.div_ceil(LANES) * length);
        for first in (0..channels).step_by(LANES) {
            for at in 0..length {
                panels.push(std::array::from_fn(|lane| match first + lane < channels {
                    true => weights[(first + lane) * length + at],
                    false => 0.0,
                }));
            }
        }
        let bias = bias.chunks(LANES).map(|part| std::array::from_fn(|lane| part.get(lane).copied().unwrap_or(0.0)));
        Self { input, output, window, activation: Activation::None, panels, bias: bias.collect() }
    }

    /// `windows` is room for the values of [`ROWS`] windows.
    pub(super) fn run(&self, input: &[f32], output: &mut [f32], windows: &mut Vec<f32>) {
        let (length, channels) = (self.panels.len() / self.bias.len(), self.output[2]);
        let is_pointwise = self.window == Window { size: [1, 1], stride: [1, 1], before: [0, 0] };
        windows.resize(ROWS * length, 0.0);
        let groups = output.len() / (ROWS * channels);
        let (whole, rest) = output.split_at_mut(groups * ROWS * channels);
        for (group, out) in whole.chunks_exact_mut(ROWS * channels).enumerate() {
            let values = match is_pointwise {
                true => &input[group * ROWS * length..][..ROWS * length],
                false => {
                    for (row, window) in windows.chunks_exact_mut(length).enumerate() {
                        self.gather(input, group * ROWS + row, window);
                    }
                    &windows[..]
                }
            };
            let values: [&[f32]; ROWS] = std::array::from_fn(|row| &values[row * length..][..length]);
            for (panel, (weights, bias)) in self.panels.chunks_exact(length).zip(&self.bias).enumerate() {
                for (row, sums) in four_sums(weights, values, *bias).into_iter().enumerate() {
                    self.put(panel * LANES, sums, &mut out[row * channels..][..channels]);
                }
            }
        }
        for (row, out) in rest.chunks_exact_mut(channels).enumerate() {
            self.gather(input, groups * ROWS + row, &mut windows[..length]);
            for (panel, (weights, bias)) in self.panels.chunks_exact(length).zip(&self.bias).enumerate() {
                self.put(panel * LANES, sums(weights, &windows[..length], *bias), out);
            }
        }
    }

    /// Writes the sums of the channels from `first` on to a pixel.
    fn put(&self, first: usize, mut sums: [f32; LANES], pixel: &mut [f32]) {
        let out = &mut pixel[first..];
        let count = out.len().min(LANES);
        self.activation.apply(&mut sums[..count], first);
        out[..count].copy_from_slice(&sums[..count]);
    }

    /// Copies the values under the window of an output pixel; 0 where it reaches over the border.
    fn gather(&self, input: &[f32], pixel: usize, window: &mut [f32]) {
        let [height, width, channels] = self.input;
        let (y, x) = (pixel / self.output[1], pixel % self.output[1]);
        let line = self.window.size[1] * channels;
        // Where a line of the window is inside, its values lie one behind the other.
        let first = (x * self.window.stride[1]).checked_sub(self.window.before[1]);
        let first = first.filter(|first| first + self.window.size[1] <= width);
        for (dy, line) in window.chunks_exact_mut(line).enumerate() {
            let Some(row) = self.window.inside(0, y, dy, height) else {
                line.fill(0.0);
                continue;
            };
            if let Some(first) = first {
                line.copy_from_slice(&input[(row * width + first) * channels..][..line.len()]);
                continue;
            }
            for (dx, values) in line.chunks_exact_mut(channels).enumerate() {
                match self.window.inside(1, x, dx, width) {
                    Some(column) => values.copy_from_slice(&input[(row * width + column) * channels..][..channels]),
                    None => values.fill(0.0),
                }
            }
        }
    }
}

/// The sums of a panel's channels over four windows. Each has a loop of its own over the lanes: written so, the compiler
/// keeps all sums in vector registers.
#[inline(never)]
fn four_sums(weights: &[[f32; LANES]], windows: [&[f32]; ROWS], bias: [f32; LANES]) -> [[f32; LANES]; ROWS] {
    let [a, b, c, d] = windows.map(|window| &window[..weights.len()]);
    let [mut w, mut x, mut y, mut z] = [bias; ROWS];
    for (i, weights) in weights.iter().enumerate() {
        let (a, b, c, d) = (a[i], b[i], c[i], d[i]);
        for lane in 0..LANES {
            w[lane] += a * weights[lane];
        }
        for lane in 0..LANES {
            x[lane] += b * weights[lane];
        }
        for lane in 0..LANES {
            y[lane] += c * weights[lane];
        }
        for lane in 0..LANES {
            z[lane] += d * weights[lane];
        }
    }
    [w, x, y, z]
}

/// The sums of a panel's channels over one window.
#[inline(never)]
fn sums(weights: &[[f32; LANES]], window: &[f32], bias: [f32; LANES]) -> [f32; LANES] {
    let mut sums = bias;
    for (value, weights) in window.iter().zip(weights) {
        for (sum, weight) in sums.iter_mut().zip(weights) {
            *sum += value * weight;
        }
    }
    sums
}

/// A convolution of each channel by itself.
#[derive(Debug, Clone)]
pub(super) struct Depthwise {
    pub input: Hwc,
    pub output: Hwc,
    pub window: Window,
    pub activation: Activation,
    /// By row, column and channel.
    pub weights: Vec<f32>,
    pub bias: Vec<f32>,
}

impl Depthwise {
    pub(super) fn run(&self, input: &[f32], output: &mut [f32]) {
        let [height, width, channels] = self.input;
        let [rows, columns] = self.window.size;
        // The pixels under a window that lie inside: the offset of their values and that of their weights.
        let mut taps: Vec<(usize, usize)> = Vec::with_capacity(rows * columns);
        for (pixel, out) in output.chunks_exact_mut(channels).enumerate() {
            let (y, x) = (pixel / self.output[1], pixel % self.output[1]);
            taps.clear();
            for dy in 0..rows {
                let Some(row) = self.window.inside(0, y, dy, height) else { continue };
                for dx in 0..columns {
                    let Some(column) = self.window.inside(1, x, dx, width) else { continue };
                    taps.push(((row * width + column) * channels, (dy * columns + dx) * channels));
                }
            }
            let whole = channels / LANES * LANES;
            for first in (0..whole).step_by(LANES) {
                self.lanes::<LANES>(input, &taps, first, &mut out[first..]);
            }
            for first in whole..channels {
                self.lanes::<1>(input, &taps, first, &mut out[first..]);
            }
            self.activation.apply(out, 0);
        }
    }
}

impl Depthwise {
    /// The sums of `N` channels from `first` on.
    #[inline]
    fn lanes<const N: usize>(&self, input: &[f32], taps: &[(usize, usize)], first: usize, out: &mut [f32]) {
        let part =
            |values: &[f32], at: usize| -> [f32; N] { values[at + first..].first_chunk().copied().unwrap_or([0.0; N]) };
        let mut sums = part(&self.bias, 0);
        for (value, weight) in taps {
            let (values, weights) = (part(input, *value), part(&self.weights, *weight));
            for lane in 0..N {
                sums[lane] += values[lane] * weights[lane];
            }
        }
        out[..N].copy_from_slice(&sums);
    }
}

/// The largest value under a window, channel by channel.
#[derive(Debug, Clone)]
pub(super) struct MaxPool {
    pub input: Hwc,
    pub output: Hwc,
    pub window: Window,
}

impl MaxPool {
    pub(super) fn run(&self, input: &[f32], output: &mut [f32]) {
        let [height, width, channels] = self.input;
        let [rows, columns] = self.window.size;
        for (pixel, out) in output.chunks_exact_mut(channels).enumerate() {
            let (y, x) = (pixel / self.output[1], pixel % self.output[1]);
            out.fill(f32::NEG_INFINITY);
            for dy in 0..rows {
                let Some(row) = self.window.inside(0, y, dy, height) else { continue };
                for dx in 0..columns {
                    let Some(column) = self.window.inside(1, x, dx, width) else { continue };
                    let values = &input[(row * width + column) * channels..][..channels];
                    for (out, value) in out.iter_mut().zip(values) {
                        *out = out.max(*value);
                    }
                }
            }
        }
    }
}
