//! A TensorFlow Lite net in memory: read once with every offset, shape and option checked, then run any number of times.
//!
//! Fifteen operations are implemented, those of the face detector and the attention mesh; a file with another is refused by
//! its name. Weights of 16 bits are widened when the file is read. Nets are float, of one image, and have no loops.

use super::attention::Region;
use super::error::{NetError, Result};
use super::flatbuffer::Table;
use super::layer::{DEQUANTIZE, Layer, Source};
use super::tensor::Tensor;

/// The most operations or tensors, values of all operations, and multiplications of a net.
const MOST_OPERATIONS: usize = 4096;
const MOST_VALUES: usize = 1 << 26;
const MOST_MULTIPLICATIONS: u64 = 1 << 32;

/// A net that can be run. It is not changed by that, so that threads can share it.
#[derive(Debug, Clone)]
pub struct Net {
    steps: Vec<Step>,
    /// The slot of each input, and its number of values.
    input: (usize, usize),
    /// The slots of the outputs.
    outputs: Vec<usize>,
    /// Lengths of the values of a run. Several values share a slot, one after the other.
    slots: Vec<usize>,
}

/// An operation and the slots that it reads and writes.
#[derive(Debug, Clone)]
struct Step {
    layer: Layer,
    inputs: Vec<usize>,
    output: usize,
    /// Number of values of each input and of the output.
    lengths: Vec<usize>,
    length: usize,
}

/// The room that a net needs while it runs. It can be used again, also by another net.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    slots: Vec<Vec<f32>>,
    windows: Vec<f32>,
}

impl Net {
    /// Reads a `.tflite` file.
    ///
    /// # Errors
    /// When it is damaged, larger than 2^24 values a tensor or 2^32 multiplications, or has an operation, a type of value or an
    /// option that is not implemented.
    pub fn read(file: &[u8]) -> Result<Self> {
        let model = Table::root(file)?;
        let buffers = model.tables(4)?;
        let graph = *model.tables(2)?.first().ok_or(NetError::Damaged)?;
        let (tables, operations) = (graph.tables(0)?, graph.tables(3)?);
        if tables.len().max(operations.len()) > MOST_OPERATIONS {
            return Err(NetError::TooLarge);
        }
        let mut tensors = tables.iter().map(|t| Tensor::read(*t, &buffers)).collect::<Result<Vec<_>>>()?;
        let mut steps = Vec::new();
        for operation in operations {
            if let Some(step) = read_step(&model, operation, &mut tensors)? {
                steps.push(step);
            }
        }
        let values = steps.iter().map(|step| step.length).fold(0, usize::saturating_add);
        let cost = steps.iter().map(|step| step.layer.cost()).fold(0, u64::saturating_add);
        if values > MOST_VALUES || cost > MOST_MULTIPLICATIONS {
            return Err(NetError::TooLarge);
        }
        let index = |index: i32| usize::try_from(index).ok().filter(|i| *i < tensors.len()).ok_or(NetError::Damaged);
        let [input] = graph.ints(1)?[..] else { return Err(NetError::Damaged) };
        let input = index(input)?;
        let outputs = graph.ints(2)?.into_iter().map(index).collect::<Result<Vec<_>>>()?;
        check_order(&steps, input, &outputs, tensors.len())?;
        absorb_activations(&mut steps, &outputs, tensors.len());
        Ok(Self::with_slots(steps, (input, tensors[input].len()), &outputs, tensors.len()))
    }

    /// Gives every value of a run a slot; a slot is free again behind the last step that reads it.
    fn with_slots(mut steps: Vec<Step>, input: (usize, usize), outputs: &[usize], count: usize) -> Self {
        let mut last_read = vec![0; count];
        for (number, step) in steps.iter().enumerate() {
            step.inputs.iter().for_each(|input| last_read[*input] = number);
        }
        outputs.iter().for_each(|output| last_read[*output] = usize::MAX);
        let mut slot_of = vec![usize::MAX; count];
        let mut slots = vec![input.1];
        let mut free: Vec<usize> = Vec::new();
        slot_of[input.0] = 0;
        for (number, step) in steps.iter_mut().enumerate() {
            let best = free.iter().enumerate().min_by_key(|(_, slot)| slots[**slot].abs_diff(step.length));
            let slot = match best.map(|(at, _)| at) {
                Some(at) => free.swap_remove(at),
                None => {
                    slots.push(0);
                    slots.len() - 1
                }
            };
            slots[slot] = slots[slot].max(step.length);
            slot_of[step.output] = slot;
            step.output = slot;
            let mut read = step.inputs.clone();
            read.sort_unstable();
            read.dedup();
            free.extend(read.into_iter().filter(|input| last_read[*input] == number).map(|input| slot_of[input]));
            step.inputs.iter_mut().for_each(|input| *input = slot_of[*input]);
        }
        let outputs = outputs.iter().map(|output| slot_of[*output]).collect();
        Self { steps, input: (0, input.1), outputs, slots }
    }

    /// Number of values of the input.
    #[must_use]
    pub fn input_len(&self) -> usize {
        self.input.1
    }

    /// Landmarks that each attention crop is made from, in the order of the net.
    pub(super) fn regions(&self) -> impl Iterator<Item = &[usize]> {
        self.steps.iter().filter_map(|step| match &step.layer {
            Layer::Region(Region { landmarks, .. }) => Some(landmarks.as_slice()),
            _ => None,
        })
    }

    /// Runs the net and returns its outputs in the order of the file, each row by row, channels last.
    ///
    /// # Panics
    /// When the input has not [`Net::input_len`] values.
    #[must_use]
    pub fn run(&self, input: &[f32], scratch: &mut Scratch) -> Vec<Vec<f32>> {
        assert_eq!(input.len(), self.input.1, "the input has the net's size");
        let Scratch { slots, windows } = scratch;
        if slots.len() < self.slots.len() {
            slots.resize(self.slots.len(), Vec::new());
        }
        for (slot, length) in slots.iter_mut().zip(&self.slots) {
            if slot.len() < *length {
                slot.resize(*length, 0.0);
            }
        }
        slots[self.input.0][..input.len()].copy_from_slice(input);
        let mut lengths = vec![0; self.slots.len()];
        for step in &self.steps {
            let mut output = std::mem::take(&mut slots[step.output]);
            let inputs: Vec<&[f32]> =
                step.inputs.iter().zip(&step.lengths).map(|(slot, length)| &slots[*slot][..*length]).collect();
            step.layer.run(&inputs, &mut output[..step.length], windows);
            slots[step.output] = output;
            lengths[step.output] = step.length;
        }
        self.outputs.iter().map(|slot| slots[*slot][..lengths[*slot]].to_vec()).collect()
    }
}

/// Reads an operation; none where it only widens constants, which the tensors then have.
fn read_step(model: &Table<'_>, operation: Table<'_>, tensors: &mut [Tensor]) -> Result<Option<Step>> {
    let codes = model.tables(1)?;
    let code = usize::try_from(operation.int(0, 0)?).ok().and_then(|i| codes.get(i)).ok_or(NetError::Damaged)?;
    // Numbers below 128 were once kept in a byte.
    let number = code.int(3, 0)?.max(i32::from(code.byte(0)?));
    let index = |i: i32| usize::try_from(i).ok().filter(|i| *i < tensors.len()).ok_or(NetError::Damaged);
    let inputs = operation.ints(1)?.into_iter().map(index).collect::<Result<Vec<_>>>()?;
    let [output] = operation.ints(2)?.into_iter().map(index).collect::<Result<Vec<_>>>()?[..] else {
        return Err(NetError::Damaged);
    };
    if number == DEQUANTIZE {
        let [input] = inputs[..] else { return Err(NetError::Damaged) };
        let constant = tensors[input].floats.clone().ok_or(NetError::Mismatch("DEQUANTIZE"))?;
        if constant.len() != tensors[output].len() {
            return Err(NetError::Mismatch("DEQUANTIZE"));
        }
        tensors[output].floats = Some(constant);
        return Ok(None);
    }
    let source = Source {
        name: std::str::from_utf8(code.bytes(1)?).map_err(|_| NetError::Damaged)?,
        number,
        options: operation.table(4)?,
        custom_options: operation.bytes(5)?,
        inputs: inputs.iter().map(|i| &tensors[*i]).collect(),
        output: &tensors[output],
    };
    let layer = source.layer()?;
    let inputs: Vec<usize> = inputs.into_iter().filter(|i| !tensors[*i].is_constant()).collect();
    let lengths: Vec<usize> = inputs.iter().map(|i| tensors[*i].len()).collect();
    if inputs.len() != layer.inputs().unwrap_or(inputs.len()) || inputs.is_empty() || tensors[output].is_constant() {
        return Err(NetError::Damaged);
    }
    Ok(Some(Step { layer, inputs, output, lengths, length: tensors[output].len() }))
}

/// Every value must be made before it is read, and once.
fn check_order(steps: &[Step], input: usize, outputs: &[usize], count: usize) -> Result<()> {
    let mut is_made = vec![false; count];
    is_made[input] = true;
    for step in steps {
        if !step.inputs.iter().all(|i| is_made[*i]) || is_made[step.output] {
            return Err(NetError::Damaged);
        }
        is_made[step.output] = true;
    }
    // An output that is the input itself is no use of a net.
    match outputs.iter().all(|output| is_made[*output] && *output != input) {
        true => Ok(()),
        false => Err(NetError::Damaged),
    }
}

/// Joins activations with the layers before them, where nothing else reads what comes between.
fn absorb_activations(steps: &mut Vec<Step>, outputs: &[usize], count: usize) {
    let mut readers = vec![0; count];
    steps.iter().flat_map(|step| &step.inputs).chain(outputs).for_each(|value| readers[*value] += 1);
    let mut maker: Vec<Option<usize>> = vec![None; count];
    let mut joined: Vec<Step> = Vec::with_capacity(steps.len());
    for step in steps.drain(..) {
        let value = step.inputs[0];
        if readers[value] == 1
            && let Some(at) = maker[value]
            && joined[at].layer.absorb(&step.layer)
        {
            joined[at].output = step.output;
            maker[step.output] = Some(at);
        } else {
            maker[step.output] = Some(joined.len());
            joined.push(step);
        }
    }
    *steps = joined;
}
