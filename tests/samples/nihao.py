#!/usr/bin/env python3
"""Makes the speech of projects/nihao, 您好, with espeak-ng and the exact times of its syllables.

    python3 tests/samples/nihao.py projects/nihao/clips/nihao

Needs libespeak-ng (Debian: libespeak-ng1). The times are the synthesiser's own phoneme events.
"""
import ctypes as c
import struct
import sys
import wave

PINYIN, LABELS = "nin2 hao3", ["您", "好"]
BEFORE, AFTER = 0.30, 0.45  # seconds of silence round the speech


class Id(c.Union):
    _fields_ = [("number", c.c_int), ("name", c.c_char_p), ("string", c.c_char * 8)]


class Event(c.Structure):
    _fields_ = [("type", c.c_int), ("unique", c.c_uint), ("text", c.c_int), ("length", c.c_int),
                ("audio_ms", c.c_int), ("sample", c.c_int), ("user", c.c_void_p), ("id", Id)]


WORD, PHONEME = 1, 7
CALLBACK = c.CFUNCTYPE(c.c_int, c.POINTER(c.c_short), c.c_int, c.POINTER(Event))


def speak(pinyin, pace=110):
    """Samples, their rate, and (kind, sample, phoneme) of every event; `pace` is words a minute."""
    lib = c.CDLL("libespeak-ng.so.1")
    rate = lib.espeak_Initialize(2, 0, None, 1)  # synchronous, with phoneme events
    samples, events = [], []

    def collect(data, count, list_of_events):
        if data and count > 0:
            samples.extend(data[i] for i in range(count))
        i = 0
        while list_of_events[i].type != 0:
            e = list_of_events[i]
            name = bytes(e.id.string).split(b"\0")[0].decode() if e.type == PHONEME else ""
            events.append((e.type, e.sample, name))
            i += 1
        return 0

    keep = CALLBACK(collect)
    lib.espeak_SetSynthCallback(keep)
    assert lib.espeak_SetVoiceByName(b"cmn-latn-pinyin+f3") == 0, "espeak-ng lacks the voice cmn-latn-pinyin"
    lib.espeak_SetParameter(1, pace, 0)
    text = (pinyin + ".").encode()
    lib.espeak_Synth(text, len(text) + 1, 0, 1, 0, 1, None, None)
    return samples, rate, events


def main(folder):
    samples, rate, events = speak(PINYIN)
    # A word event opens a syllable; it ends with the last sounding phoneme before the next one.
    syllables = []
    for (kind, start, name), (_, end, _) in zip(events, events[1:] + [(0, len(samples), "")]):
        if kind == WORD and len(syllables) < len(LABELS):
            syllables.append([None, None])
        elif kind == PHONEME and syllables and not name.startswith("_") and end > start:
            syllables[-1][0] = start if syllables[-1][0] is None else syllables[-1][0]
            syllables[-1][1] = end
    first, last = syllables[0][0], syllables[-1][1]
    pad = lambda seconds: [0] * int(seconds * rate)
    sound = pad(BEFORE) + samples[first:last] + pad(AFTER)
    with wave.open(f"{folder}/speech.wav", "wb") as out:
        out.setnchannels(1), out.setsampwidth(2), out.setframerate(rate)
        out.writeframes(struct.pack(f"<{len(sound)}h", *sound))
    duration = len(sound) / rate
    rows, at = [], 0.0
    for label, (start, end) in zip(LABELS, syllables):
        start, end = ((t - first) / rate + BEFORE for t in (start, end))
        if start - at > 1e-4:
            rows.append((at, start, ""))
        rows.append((start, end, label))
        at = end
    rows.append((at, duration, ""))
    with open(f"{folder}/timing.TextGrid", "w", encoding="utf-8") as out:
        out.write('File type = "ooTextFile"\nObject class = "TextGrid"\n\nxmin = 0\n')
        out.write(f"xmax = {duration:.6f}\ntiers? <exists>\nsize = 1\nitem []:\n    item [1]:\n")
        out.write('        class = "IntervalTier"\n        name = "syllables"\n        xmin = 0\n')
        out.write(f"        xmax = {duration:.6f}\n        intervals: size = {len(rows)}\n")
        for i, (start, end, label) in enumerate(rows, 1):
            out.write(f"        intervals [{i}]:\n            xmin = {start:.6f}\n            xmax = {end:.6f}\n")
            out.write(f'            text = "{label}"\n')


if __name__ == "__main__":
    main(sys.argv[1])
