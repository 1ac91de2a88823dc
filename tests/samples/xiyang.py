#!/usr/bin/env python3
"""Makes the speech of projects/xiyang, 夕陽真美, with espeak-ng, and the exact times of its syllables and mouth shapes.

    python3 tests/samples/xiyang.py projects/xiyang/clips/xiyang tests/truth

The sound goes to the first folder, the times (xiyang.TextGrid) to the second: by them the mouth of the rendered frames
moves. Needs libespeak-ng (Debian: libespeak-ng1). The times are the synthesiser's own phoneme events.
"""
import struct
import sys
import wave

from nihao import PHONEME, WORD, speak

PINYIN, LABELS = "xi1 yang2 zhen1 mei3", "夕陽真美"
DURATION, BEFORE = 3.0, 0.72  # seconds, and of them the silence before the speech

# What the lips do at each phoneme, as one of the nine shapes; ei is two.
SHAPES = {"S;": "i", "i": "i", "j": "i", "iA": "a", "N": "n", "ts.": "h", "@": "h", "n": "n", "m": "m", "ei": "ei"}


def tier(out, number, name, rows):
    out.write(f'    item [{number}]:\n        class = "IntervalTier"\n        name = "{name}"\n        xmin = 0\n')
    out.write(f"        xmax = {DURATION:g}\n        intervals: size = {len(rows)}\n")
    for i, (start, end, label) in enumerate(rows, 1):
        out.write(f"        intervals [{i}]:\n            xmin = {start:.4f}\n            xmax = {end:.4f}\n")
        out.write(f'            text = "{label}"\n')


def filled(rows):
    """The rows with silence between them, from 0 to the end."""
    whole, at = [], 0.0
    for start, end, label in rows:
        if start - at > 1e-4:
            whole.append((at, start, ""))
        whole.append((start, end, label))
        at = end
    return whole + [(at, DURATION, "")]


def main(sound_folder, truth_folder):
    samples, rate, events = speak(PINYIN, 140)
    syllables, shapes = [], []
    spoken = [(s, e, n) for (k, s, n), (_, e, _) in zip(events, events[1:]) if k == PHONEME and e > s]
    starts = [s for (k, s, _) in events if k == WORD][:len(LABELS)]
    first = min(s for s, _, n in spoken if not n.startswith("_"))
    last = max(e for _, e, n in spoken if not n.startswith("_"))
    time = lambda s: (s - first) / rate + BEFORE
    for start, end, name in spoken:
        if name.startswith("_"):
            continue
        number = sum(s <= start for s in starts) - 1
        if number == len(syllables):
            syllables.append([time(start), time(end), LABELS[number]])
        syllables[number][1] = time(end)
        parts = SHAPES[name]
        for i, letter in enumerate(parts):
            step = (end - start) / len(parts)
            row = [time(start + i * step), time(start + (i + 1) * step), letter]
            if shapes and shapes[-1][2] == letter and row[0] - shapes[-1][1] < 1e-4 and row[0] > syllables[-1][0]:
                shapes[-1][1] = row[1]
            else:
                shapes.append(row)
    total = round(DURATION * rate)
    sound = [0] * round(BEFORE * rate) + samples[first:last]
    sound += [0] * (total - len(sound))
    with wave.open(f"{sound_folder}/speech.wav", "wb") as out:
        out.setnchannels(1), out.setsampwidth(2), out.setframerate(rate)
        out.writeframes(struct.pack(f"<{total}h", *sound[:total]))
    with open(f"{truth_folder}/xiyang.TextGrid", "w", encoding="utf-8") as out:
        out.write('File type = "ooTextFile"\nObject class = "TextGrid"\n\nxmin = 0\n')
        out.write(f"xmax = {DURATION:g}\ntiers? <exists>\nsize = 2\nitem []:\n")
        tier(out, 1, "syllables", filled(syllables))
        tier(out, 2, "shapes", filled(shapes))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
