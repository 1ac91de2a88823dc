//! The operations of a net: read from the file with every shape checked, so that running them cannot fail.

use super::attention::{Region, Sampler, carry_back};
use super::convolution::{Activation, Convolution, Depthwise, Hwc, MaxPool, Window};
use super::error::{NetError, Result};
use super::flatbuffer::Table;
use super::tensor::Tensor;

/// What an operation does with its inputs, which are values of the run; constants are part of it.
#[derive(Debug, Clone)]
pub(super) enum Layer {
    Convolution(Convolution),
    Depthwise(Depthwise),
    MaxPool(MaxPool),
    /// The same values in another shape.
    Copy,
    /// Value by value, for channels in turn.
    Activate {
        activation: Activation,
        channels: usize,
    },
    /// The sum of two tensors of one shape.
    Add {
        activation: Activation,
        channels: usize,
    },
    /// The product with constants that repeat.
    Scale(Vec<f32>),
    /// Tensors one behind the other.
    Join,
    /// Zeros before and behind the channels of each pixel.
    PadChannels {
        before: usize,
        channels: usize,
        padded: usize,
    },
    Region(Region),
    Sampler(Sampler),
    CarryBack,
}

/// An operation as the file tells it.
pub(super) struct Source<'a> {
    pub name: &'a str,
    pub number: i32,
    pub options: Option<Table<'a>>,
    pub custom_options: &'a [u8],
    pub inputs: Vec<&'a Tensor>,
    pub output: &'a Tensor,
}

/// Operations by their numbers in the format.
const ADD: i32 = 0;
const CONCATENATION: i32 = 2;
const CONV_2D: i32 = 3;
const DEPTHWISE_CONV_2D: i32 = 4;
const MAX_POOL_2D: i32 = 17;
const MUL: i32 = 18;
const RELU: i32 = 19;
const RESHAPE: i32 = 22;
const CUSTOM: i32 = 32;
const PAD: i32 = 34;
const STRIDED_SLICE: i32 = 45;
const PRELU: i32 = 54;
/// Constants stored with 16 bits a value; they are widened when the file is read.
pub(super) const DEQUANTIZE: i32 = 6;

impl Source<'_> {
    /// Reads the operation.
    pub(super) fn layer(&self) -> Result<Layer> {
        match (self.number, self.name) {
            (CONV_2D, _) => self.convolution(),
            (DEPTHWISE_CONV_2D, _) => self.depthwise(),
            (MAX_POOL_2D, _) => self.pool(),
            (ADD, _) => self.add(),
            (MUL, _) => self.scale(),
            (RELU, _) => self.activate(Activation::Relu, "RELU"),
            (PRELU, _) => {
                let slopes = self.constant(1, "PRELU")?.to_vec();
                match slopes.len() == self.output.channels() {
                    true => self.activate(Activation::Prelu(slopes), "PRELU"),
                    false => Err(NetError::Mismatch("PRELU")),
                }
            }
            (RESHAPE, _) => self.copy("RESHAPE"),
            (STRIDED_SLICE, _) => self.whole_slice(),
            (CONCATENATION, _) => self.join(),
            (PAD, _) => self.pad(),
            (CUSTOM, "Landmarks2TransformMatrix") => self.region(),
            (CUSTOM, "TransformTensorBilinear") => self.sampler(),
            (CUSTOM, "TransformLandmarks") => self.carry_back(),
            (CUSTOM, name) => Err(NetError::UnknownOperation(name.chars().take(40).collect())),
            (number, _) => Err(NetError::UnknownOperation(format!("number {number}"))),
        }
    }

    fn input(&self, index: usize, name: &'static str) -> Result<&Tensor> {
        self.inputs.get(index).copied().ok_or(NetError::Mismatch(name))
    }

    /// An input that the file has.
    fn constant(&self, index: usize, name: &'static str) -> Result<&[f32]> {
        self.input(index, name)?.floats.as_deref().ok_or(NetError::Mismatch(name))
    }

    fn image(tensor: &Tensor, name: &'static str) -> Result<Hwc> {
        match tensor.shape[..] {
            [1, height, width, channels] => Ok([height, width, channels]),
            _ => Err(NetError::Mismatch(name)),
        }
    }

    fn option(&self, index: usize, default: i32, name: &'static str) -> Result<usize> {
        let value = self.options.map_or(Ok(default), |options| options.int(index, default))?;
        usize::try_from(value).map_err(|_| NetError::Mismatch(name))
    }

    fn activation(&self, field: usize, name: &'static str) -> Result<Activation> {
        match self.options.map_or(Ok(0), |options| options.byte(field))? {
            0 => Ok(Activation::None),
            1 => Ok(Activation::Relu),
            3 => Ok(Activation::Relu6),
            _ => Err(NetError::Mismatch(name)),
        }
    }

    /// The window of a size, with the stride and padding of the options. The output must be as large as they make it.
    fn window(&self, size: [usize; 2], input: Hwc, output: Hwc, name: &'static str) -> Result<Window> {
        // Padding: 0 keeps the size, divided by the stride; 1 takes only whole windows.
        let is_same = match self.options.map_or(Ok(0), |options| options.byte(0))? {
            0 => true,
            1 => false,
            _ => return Err(NetError::Mismatch(name)),
        };
        let stride = [self.option(2, 1, name)?, self.option(1, 1, name)?];
        let mut before = [0; 2];
        for axis in 0..2 {
            let (input, stride, size) = (input[axis], stride[axis], size[axis]);
            if stride == 0 || size == 0 || size > 64 || stride > 64 {
                return Err(NetError::Mismatch(name));
            }
            let fits = match is_same {
                true => Some(input.div_ceil(stride)),
                false => input.checked_sub(size).map(|rest| rest / stride + 1),
            };
            if fits != Some(output[axis]) {
                return Err(NetError::Mismatch(name));
            }
            if is_same {
                before[axis] = ((output[axis] - 1) * stride + size).saturating_sub(input) / 2;
            }
        }
        Ok(Window { size, stride, before })
    }

    fn convolution(&self) -> Result<Layer> {
        const NAME: &str = "CONV_2D";
        let (input, output) = (Self::image(self.input(0, NAME)?, NAME)?, Self::image(self.output, NAME)?);
        let (weights, bias) = (self.constant(1, NAME)?, self.constant(2, NAME)?);
        let &[channels, height, width, depth] = &self.input(1, NAME)?.shape[..] else {
            return Err(NetError::Mismatch(NAME));
        };
        let is_dilated = self.option(4, 1, NAME)? != 1 || self.option(5, 1, NAME)? != 1;
        if [channels, depth] != [output[2], input[2]] || bias.len() != channels || is_dilated {
            return Err(NetError::Mismatch(NAME));
        }
        let window = self.window([height, width], input, output, NAME)?;
        let mut convolution = Convolution::new(input, output, window, weights, bias);
        convolution.activation = self.activation(3, NAME)?;
        Ok(Layer::Convolution(convolution))
    }

    fn depthwise(&self) -> Result<Layer> {
        const NAME: &str = "DEPTHWISE_CONV_2D";
        let (input, output) = (Self::image(self.input(0, NAME)?, NAME)?, Self::image(self.output, NAME)?);
        let (weights, bias) = (self.constant(1, NAME)?, self.constant(2, NAME)?);
        let &[1, height, width, channels] = &self.input(1, NAME)?.shape[..] else {
            return Err(NetError::Mismatch(NAME));
        };
        let is_dilated = self.option(5, 1, NAME)? != 1 || self.option(6, 1, NAME)? != 1;
        if input[2] != channels || output[2] != channels || bias.len() != channels || is_dilated {
            return Err(NetError::Mismatch(NAME));
        }
        let window = self.window([height, width], input, output, NAME)?;
        let activation = self.activation(4, NAME)?;
        let (weights, bias) = (weights.to_vec(), bias.to_vec());
        Ok(Layer::Depthwise(Depthwise { input, output, window, activation, weights, bias }))
    }

    fn pool(&self) -> Result<Layer> {
        const NAME: &str = "MAX_POOL_2D";
        let (input, output) = (Self::image(self.input(0, NAME)?, NAME)?, Self::image(self.output, NAME)?);
        let size = [self.option(4, 1, NAME)?, self.option(3, 1, NAME)?];
        let window = self.window(size, input, output, NAME)?;
        match input[2] == output[2] && self.activation(5, NAME)? == Activation::None {
            true => Ok(Layer::MaxPool(MaxPool { input, output, window })),
            false => Err(NetError::Mismatch(NAME)),
        }
    }

    fn add(&self) -> Result<Layer> {
        const NAME: &str = "ADD";
        let (a, b) = (self.input(0, NAME)?, self.input(1, NAME)?);
        if a.shape != b.shape || a.shape != self.output.shape || a.floats.is_some() || b.floats.is_some() {
            return Err(NetError::Mismatch(NAME));
        }
        Ok(Layer::Add { activation: self.activation(0, NAME)?, channels: self.output.channels() })
    }

    fn scale(&self) -> Result<Layer> {
        const NAME: &str = "MUL";
        let factors = self.constant(1, NAME)?.to_vec();
        let same = self.input(0, NAME)?.shape == self.output.shape && self.activation(0, NAME)? == Activation::None;
        match same && !factors.is_empty() && self.output.len().is_multiple_of(factors.len()) {
            true => Ok(Layer::Scale(factors)),
            false => Err(NetError::Mismatch(NAME)),
        }
    }

    fn activate(&self, activation: Activation, name: &'static str) -> Result<Layer> {
        match self.input(0, name)?.shape == self.output.shape {
            true => Ok(Layer::Activate { activation, channels: self.output.channels() }),
            false => Err(NetError::Mismatch(name)),
        }
    }

    fn copy(&self, name: &'static str) -> Result<Layer> {
        match self.input(0, name)?.len() == self.output.len() {
            true => Ok(Layer::Copy),
            false => Err(NetError::Mismatch(name)),
        }
    }

    /// A slice of a whole tensor: from its start, by single steps.
    fn whole_slice(&self) -> Result<Layer> {
        const NAME: &str = "STRIDED_SLICE";
        let all = |index: usize, value: i32| Ok(self.input(index, NAME)?.ints.iter().all(|i| *i == value));
        match all(1, 0)? && all(3, 1)? {
            true => self.copy(NAME),
            false => Err(NetError::Mismatch(NAME)),
        }
    }

    /// Concatenation along the first axis that is longer than 1.
    fn join(&self) -> Result<Layer> {
        const NAME: &str = "CONCATENATION";
        let axis = self.option(0, 0, NAME)?;
        let is_first = |shape: &[usize]| shape.iter().take(axis).all(|length| *length == 1);
        let rest = |shape: &[usize]| shape.get(axis + 1..).map(<[usize]>::to_vec);
        let output = &self.output.shape;
        let fits = self
            .inputs
            .iter()
            .all(|input| is_first(&input.shape) && rest(&input.shape) == rest(output) && input.floats.is_none());
        let length: usize = self.inputs.iter().map(|input| input.len()).sum();
        match fits && length == self.output.len() && self.activation(1, NAME)? == Activation::None {
            true => Ok(Layer::Join),
            false => Err(NetError::Mismatch(NAME)),
        }
    }

    fn pad(&self) -> Result<Layer> {
        const NAME: &str = "PAD";
        let (input, output) = (Self::image(self.input(0, NAME)?, NAME)?, Self::image(self.output, NAME)?);
        let &[0, 0, 0, 0, 0, 0, before, after] = &self.input(1, NAME)?.ints[..] else {
            return Err(NetError::Mismatch(NAME));
        };
        let amount = |value: i32| usize::try_from(value).map_err(|_| NetError::Mismatch(NAME));
        let (before, after) = (amount(before)?, amount(after)?);
        match output == [input[0], input[1], input[2].saturating_add(before).saturating_add(after)] {
            true => Ok(Layer::PadChannels { before, channels: input[2], padded: output[2] }),
            false => Err(NetError::Mismatch(NAME)),
        }
    }

    fn region(&self) -> Result<Layer> {
        const NAME: &str = "Landmarks2TransformMatrix";
        match (&self.input(0, NAME)?.shape[..], &self.output.shape[..]) {
            (&[1, count, 3], [1, 4, 4]) => Ok(Layer::Region(Region::read(self.custom_options, count)?)),
            _ => Err(NetError::Mismatch(NAME)),
        }
    }

    fn sampler(&self) -> Result<Layer> {
        const NAME: &str = "TransformTensorBilinear";
        let (input, output) = (Self::image(self.input(0, NAME)?, NAME)?, Self::image(self.output, NAME)?);
        match self.input(1, NAME)?.shape == [1, 4, 4] && input[2] == output[2] {
            true => Ok(Layer::Sampler(Sampler { input, output })),
            false => Err(NetError::Mismatch(NAME)),
        }
    }

    fn carry_back(&self) -> Result<Layer> {
        const NAME: &str = "TransformLandmarks";
        let shape = &self.input(0, NAME)?.shape;
        let is_pairs = matches!(shape[..], [1, _, 2]) && *shape == self.output.shape;
        match is_pairs && self.input(1, NAME)?.shape == [1, 4, 4] {
            true => Ok(Layer::CarryBack),
            false => Err(NetError::Mismatch(NAME)),
        }
    }
}

impl Layer {
    /// Number of inputs that are no constants; none where it may be any.
    pub(super) fn inputs(&self) -> Option<usize> {
        match self {
            Self::Add { .. } | Self::Sampler(_) | Self::CarryBack => Some(2),
            Self::Join => None,
            _ => Some(1),
        }
    }

    /// Multiplications of a run, as far as they count.
    pub(super) fn cost(&self) -> u64 {
        let product = |shape: Hwc, window: Window, depth: usize| {
            [shape[0], shape[1], shape[2], window.size[0], window.size[1], depth].map(|v| v as u64).iter().product()
        };
        match self {
            Self::Convolution(c) => product(c.output, c.window, c.input[2]),
            Self::Depthwise(c) => product(c.output, c.window, 1),
            Self::MaxPool(c) => product(c.output, c.window, 1),
            _ => 0,
        }
    }

    /// Lets an activation follow at once; false where this layer already has one, or cannot have it.
    pub(super) fn absorb(&mut self, next: &Self) -> bool {
        let Self::Activate { activation: next, .. } = next else { return false };
        let own = match self {
            Self::Convolution(c) => &mut c.activation,
            Self::Depthwise(c) => &mut c.activation,
            Self::Add { activation, .. } => activation,
            _ => return false,
        };
        if *own != Activation::None {
            return false;
        }
        own.clone_from(next);
        true
    }

    /// Computes the output. `windows` is room that convolutions share.
    pub(super) fn run(&self, inputs: &[&[f32]], output: &mut [f32], windows: &mut Vec<f32>) {
        let first = inputs[0];
        match self {
            Self::Convolution(convolution) => convolution.run(first, output, windows),
            Self::Depthwise(convolution) => convolution.run(first, output),
            Self::MaxPool(pool) => pool.run(first, output),
            Self::Copy => output.copy_from_slice(first),
            Self::Activate { activation, channels } => {
                output.copy_from_slice(first);
                output.chunks_exact_mut(*channels).for_each(|pixel| activation.apply(pixel, 0));
            }
            Self::Add { activation, channels } => {
                let pixels = first.chunks_exact(*channels).zip(inputs[1].chunks_exact(*channels));
                for (out, (a, b)) in output.chunks_exact_mut(*channels).zip(pixels) {
                    for ((out, a), b) in out.iter_mut().zip(a).zip(b) {
                        *out = a + b;
                    }
                    activation.apply(out, 0);
                }
            }
            Self::Scale(factors) => {
                for (out, values) in output.chunks_exact_mut(factors.len()).zip(first.chunks_exact(factors.len())) {
                    for ((out, value), factor) in out.iter_mut().zip(values).zip(factors) {
                        *out = value * factor;
                    }
                }
            }
            Self::Join => {
                let mut rest = output;
                for input in inputs {
                    let (own, behind) = rest.split_at_mut(input.len());
                    own.copy_from_slice(input);
                    rest = behind;
                }
            }
            Self::PadChannels { before, channels, padded } => {
                output.fill(0.0);
                for (out, values) in output.chunks_exact_mut(*padded).zip(first.chunks_exact(*channels)) {
                    out[*before..][..*channels].copy_from_slice(values);
                }
            }
            Self::Region(region) => region.run(first, output),
            Self::Sampler(sampler) => sampler.run(first, inputs[1], output),
            Self::CarryBack => carry_back(first, inputs[1], output),
        }
    }
}
