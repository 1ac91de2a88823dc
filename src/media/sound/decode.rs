//! Recordings that are compressed, and the sound of videos: symphonia takes them apart and decodes them.
//!
//! What is damaged becomes silence of the same length, so that what follows keeps its time, and what an encoder put
//! before and behind the sound is taken off.

use std::fs::File;

use symphonia::core::codecs::CodecParameters;
use symphonia::core::codecs::audio::well_known as codec;
use symphonia::core::codecs::audio::{AudioCodecId, AudioCodecParameters, AudioDecoder, AudioDecoderOptions};
use symphonia::core::errors::Error;
use symphonia::core::formats::probe::Hint;
use symphonia::core::formats::{FormatReader, Track, TrackType};
use symphonia::core::io::MediaSourceStream;
use symphonia::core::units::TimeBase;

use super::iso::Index;
use super::kind::Kind;
use super::mix::Mixer;
use super::mp3;
use super::raw::{RATES, Raw, broken, short_enough};
use crate::disk::{Fault, FileFault, Result};

/// Samples that encoders of MP3 put before the sound where the file does not say it: LAME's 576, and the 529 by which
/// every decoder is late.
const MP3_DELAY: usize = 576 + 529;

/// Samples before the sound in AAC where the file does not say it: one frame, the least an encoder can do.
const AAC_DELAY: usize = 1024;

/// Times of packets that are further apart than what was decoded between them are a gap, in seconds. MKV rounds to
/// milliseconds, and what is left out at the beginning may be 48 ms.
const GAP: f64 = 0.06;

/// Silence in place of what is missing: no more than was decoded before and this, in seconds. A damaged time stamp may
/// lie hours ahead.
const MOST_MISSING: f64 = 60.0;

/// Samples that may be missing where an MP3 says how many it has, without a word: fewer than a frame.
const MISSING: u64 = 1000;

/// As many packets may fail before a file is given up in which none has been decoded.
const PATIENCE: usize = 200;

/// Reads a file; a fault without a next step is one of the kind, for which converting helps.
pub(super) fn read(mut file: File, kind: Kind, only: Option<usize>) -> Result<Raw> {
    let index = if kind == Kind::Iso { Index::find(&mut file).map_err(broken)? } else { None };
    let holes = if kind == Kind::Mp3 { mp3::holes(&mut file).map_err(broken)? } else { Vec::new() };
    std::io::Seek::rewind(&mut file).map_err(broken)?;
    let stream = MediaSourceStream::new(Box::new(file), Default::default());
    let opened = symphonia::default::get_probe().probe(&Hint::new(), stream, Default::default(), Default::default());
    let mut format = opened.map_err(|error| match (kind, &index) {
        (Kind::Iso, None) => Fault::of(FileFault::CutOff, "the recording was never finished: its index is missing")
            .help("record it again, or repair it with a program such as untrunc"),
        _ => Fault::new(format!("cannot find the sound in it: {error}")),
    })?;
    let mut decoding = Decoding::begin(format.as_mut(), only)?;
    decoding.all(format.as_mut())?;
    let Some((rate, mut mixer)) = decoding.mixer.take() else {
        return Err(match decoding.failed {
            Some(error) => Fault::new(format!("cannot decode its sound: {error}")),
            None => Fault::of(FileFault::Empty, "there is no sound in the file")
                .help("was it cut off? record or save it again"),
        });
    };
    let delay = match index.and_then(|index| index.edit(decoding.track, rate)) {
        Some(edit) => {
            let frames = |seconds: f64| (seconds * f64::from(rate)).round() as usize;
            mixer.trim(frames(edit.skip), edit.length.map(frames));
            0
        }
        None if kind == Kind::Mp3 && decoding.delay == 0 => MP3_DELAY,
        None if decoding.codec == codec::CODEC_ID_AAC => AAC_DELAY,
        None => 0,
    };
    mixer.trim(delay, None);
    // From the last, so that the places of those before stay as they are.
    let cut = if decoding.delay > 0 { decoding.delay } else { delay };
    for hole in holes.iter().rev() {
        short_enough((mixer.frames() + hole.lost) as u64, rate)?;
        let at = hole.at.saturating_sub(cut);
        mixer.insert(at, hole.lost);
        decoding.damaged_at(at as f64 / f64::from(rate));
        decoding.damaged.1 = decoding.damaged.1.min(at as f64 / f64::from(rate));
    }
    let mut warnings = decoding.warnings;
    if let Some(missing) = decoding.said.and_then(|said| said.checked_sub(mixer.frames() as u64))
        && decoding.delay > 0
        && missing > MISSING
    {
        let missing = missing as f64 / f64::from(rate);
        warnings.push(format!("{missing:.2} s of the file are cut off or damaged"));
    }
    if decoding.damaged.0 > 0 {
        let (count, first) = decoding.damaged;
        let parts =
            if count == 1 { "1 part of the file is".to_owned() } else { format!("{count} parts of the file are") };
        warnings.push(format!("{parts} damaged and silent, the first at {first:.2} s"));
    }
    if mixer.frames() == 0 {
        return Err(Fault::of(FileFault::Empty, "there is no sound in the file")
            .help("was it cut off? record or save it again"));
    }
    Ok(Raw { rate, mixed: mixer.done(), warnings })
}

/// A track in the middle of being decoded.
struct Decoding {
    track: u32,
    codec: AudioCodecId,
    base: Option<TimeBase>,
    decoder: Box<dyn AudioDecoder>,
    /// Rate and samples, from the first packet that could be decoded.
    mixer: Option<(u32, Mixer)>,
    only: Option<usize>,
    /// The time that the first sample has, in units of the track.
    origin: Option<i64>,
    /// Samples that the file says its encoder put before the sound, which the decoder takes off.
    delay: usize,
    /// How many samples the file says that there are.
    said: Option<u64>,
    /// How many packets could not be decoded, and when the first should have sounded.
    damaged: (usize, f64),
    /// Silence in place of what is missing so far, in seconds.
    silent: f64,
    /// Whether the times in the file leapt too far to be believed.
    leapt: bool,
    /// Why the first of them could not.
    failed: Option<String>,
    warnings: Vec<String>,
}

impl Decoding {
    fn begin(format: &mut dyn FormatReader, only: Option<usize>) -> Result<Self> {
        let tracks = format.tracks();
        let mut refused = None;
        for track in tracks.iter().filter(|track| track.track_type() == Some(TrackType::Audio)) {
            let Some(parameters) = audio(track) else { continue };
            match make(parameters) {
                Ok(decoder) => {
                    return Ok(Self {
                        track: track.id,
                        codec: parameters.codec,
                        base: track.time_base,
                        decoder,
                        mixer: None,
                        only,
                        origin: None,
                        delay: track.delay.unwrap_or(0) as usize,
                        said: track.num_frames,
                        damaged: (0, 0.0),
                        silent: 0.0,
                        leapt: false,
                        failed: None,
                        warnings: Vec::new(),
                    });
                }
                Err(_) => refused = refused.or(Some(named(parameters.codec))),
            }
        }
        Err(match refused {
            Some(name) => {
                Fault::of(FileFault::Unsupported, format!("its sound is compressed as {name}, which is not read"))
            }
            None if tracks.is_empty() => Fault::of(FileFault::Empty, "there is no sound in the file"),
            None => Fault::of(FileFault::Empty, "there is no sound track that can be read in the file"),
        })
    }

    fn all(&mut self, format: &mut dyn FormatReader) -> Result<()> {
        let mut samples: Vec<f32> = Vec::new();
        loop {
            let packet = match format.next_packet() {
                Ok(Some(packet)) => packet,
                Ok(None) => return Ok(()),
                Err(Error::ResetRequired) => {
                    if !self.follow(format) {
                        return Ok(());
                    }
                    continue;
                }
                Err(error) => {
                    if self.mixer.is_none() {
                        return Err(Fault::new(format!("cannot read the sound in it: {error}")));
                    }
                    self.warnings.push(format!("the file was cut off or is damaged: {:.2} s are used", self.seconds()));
                    return Ok(());
                }
            };
            if packet.track_id != self.track {
                continue;
            }
            self.fill(packet.pts.get())?;
            match self.decoder.decode(&packet) {
                Ok(buffer) => {
                    let (rate, channels) = (buffer.spec().rate(), buffer.spec().channels().count());
                    buffer.copy_to_vec_interleaved(&mut samples);
                    if !self.take(rate, channels, &samples)? {
                        return Ok(());
                    }
                }
                // Damage looks like anything, also like a feature that is not supported.
                Err(error) => self.lose(packet.dur.get(), &error)?,
            }
        }
    }

    /// Mixes what a packet held; false where the file goes on as another kind of sound.
    fn take(&mut self, rate: u32, channels: usize, samples: &[f32]) -> Result<bool> {
        if samples.is_empty() {
            return Ok(true);
        }
        if channels == 0 || !RATES.contains(&rate) {
            return Err(Fault::of(
                FileFault::Mismatch,
                format!("the file says that it has {channels} channels, {rate} samples a second"),
            ));
        }
        let only = self.only;
        let (known, mixer) = self.mixer.get_or_insert_with(|| (rate, Mixer::new(channels, only, 0)));
        if *known != rate || mixer.channels() != channels {
            let used = self.seconds();
            self.warnings
                .push(format!("at {used:.2} s the file changes its rate or channels; what follows is not used"));
            return Ok(false);
        }
        samples.iter().for_each(|sample| mixer.push(f64::from(*sample)));
        short_enough(mixer.frames() as u64, rate)?;
        Ok(true)
    }

    /// Silence where the time of the next packet lies behind what has been decoded. Times that leap too far ahead are
    /// damaged: what follows comes at once and is timed from there, until they leap back.
    fn fill(&mut self, time: i64) -> Result<()> {
        let origin = *self.origin.get_or_insert(time.max(0));
        let there = self.seconds();
        let due = self.in_seconds(time.saturating_sub(origin));
        if self.mixer.is_none() {
            return Ok(());
        }
        if self.leapt && due < there - MOST_MISSING {
            self.rebase(time);
        } else if due > there + GAP {
            self.damaged_at(there);
            if !self.silence(due - there)? {
                if !std::mem::replace(&mut self.leapt, true) {
                    let by = due - there;
                    self.warnings
                        .push(format!("at {there:.2} s the times in the file leap {by:.0} s ahead; that is left out"));
                }
                self.rebase(time);
            }
        }
        Ok(())
    }

    /// Lets a time of the track stand for where decoding is.
    fn rebase(&mut self, time: i64) {
        let units =
            self.base.map_or(0.0, |base| self.seconds() * f64::from(base.denom.get()) / f64::from(base.numer.get()));
        self.origin = Some(time.saturating_sub(units as i64));
    }

    /// Silence instead of a packet that could not be decoded.
    fn lose(&mut self, duration: u64, error: &Error) -> Result<()> {
        let there = self.seconds();
        self.damaged_at(there);
        self.failed.get_or_insert_with(|| error.to_string());
        if self.mixer.is_none() && self.damaged.0 > PATIENCE {
            return Err(Fault::new(format!("nothing in the file can be decoded: {error}")));
        }
        let lost = self.in_seconds(i64::try_from(duration).unwrap_or(0));
        self.silence(lost)?;
        Ok(())
    }

    fn damaged_at(&mut self, time: f64) {
        if self.damaged.0 == 0 {
            self.damaged.1 = time;
        }
        self.damaged.0 += 1;
    }

    /// Puts silence in place of what is missing; false where that is more than can be believed, and none is put.
    fn silence(&mut self, seconds: f64) -> Result<bool> {
        let (seconds, there) = (seconds.max(0.0), self.seconds());
        let Some((rate, mixer)) = &mut self.mixer else { return Ok(true) };
        if self.silent + seconds > there - self.silent + MOST_MISSING {
            return Ok(false);
        }
        self.silent += seconds;
        let frames = (seconds * f64::from(*rate)).round();
        short_enough(mixer.frames() as u64 + frames as u64, *rate)?;
        mixer.silence(frames as usize);
        Ok(true)
    }

    /// How much has been decoded.
    fn seconds(&self) -> f64 {
        self.mixer.as_ref().map_or(0.0, |(rate, mixer)| mixer.frames() as f64 / f64::from(*rate))
    }

    fn in_seconds(&self, units: i64) -> f64 {
        self.base.map_or(0.0, |base| units as f64 * f64::from(base.numer.get()) / f64::from(base.denom.get()))
    }

    /// Goes on with the next of several recordings in one OGG file; false where there is none that can be read.
    fn follow(&mut self, format: &mut dyn FormatReader) -> bool {
        let next = format.tracks().iter().find_map(|track| Some((track, make(audio(track)?).ok()?)));
        let Some((track, decoder)) = next else { return false };
        // Its times begin anew.
        (self.track, self.base, self.decoder) = (track.id, track.time_base, decoder);
        self.rebase(0);
        true
    }
}

fn audio(track: &Track) -> Option<&AudioCodecParameters> {
    track.codec_params.as_ref().and_then(CodecParameters::audio)
}

fn make(parameters: &AudioCodecParameters) -> symphonia::core::errors::Result<Box<dyn AudioDecoder>> {
    symphonia::default::get_codecs().make_audio_decoder(parameters, &AudioDecoderOptions::default())
}

/// What people call a way of compressing.
fn named(id: AudioCodecId) -> &'static str {
    match id {
        codec::CODEC_ID_OPUS => "Opus",
        codec::CODEC_ID_SPEEX => "Speex",
        codec::CODEC_ID_AAC => "AAC of a kind other than plain AAC-LC",
        codec::CODEC_ID_AC3 | codec::CODEC_ID_EAC3 => "Dolby Digital",
        codec::CODEC_ID_DCA => "DTS",
        codec::CODEC_ID_MP1 | codec::CODEC_ID_MP2 => "MPEG audio of layer 1 or 2",
        codec::CODEC_ID_WMA => "WMA",
        codec::CODEC_ID_ADPCM_G722 | codec::CODEC_ID_ADPCM_G726 | codec::CODEC_ID_ADPCM_G726LE => "ADPCM of G.72x",
        _ => "something",
    }
}
