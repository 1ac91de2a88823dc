#!/usr/bin/env python3
"""Makes src/script/lookalikes.txt: common English words that can also be read as Pinyin.

    apt-get download scowl && dpkg -x scowl_*.deb DIR
    python3 tests/learn/lookalikes.py DIR/usr/share/dict/scowl src/script

From the lists of SCOWL up to size 35 (its licence is in src/script/NOTICE.md).
"""
import re
import sys

folder, out = sys.argv[1], sys.argv[2]
rows = [r.split(",") for r in open(f"{out}/syllables.csv", encoding="utf-8").read().splitlines()[1:]]
spelled = {r[0] for r in rows if r[5] != "interj"} | {r[2] for r in rows if r[5] != "interj"}
spelled = {s.replace("ü", "v") for s in spelled}
words = set()
for name in ("english-words", "american-words"):
    for size in (10, 20, 35):
        text = open(f"{folder}/{name}.{size}", encoding="latin-1").read()
        words |= {w for w in text.split() if re.fullmatch("[a-z]+", w)}


def splits(word):
    return not word or any(word[:n] in spelled and splits(word[n:]) for n in range(1, 7) if n <= len(word))


found = sorted(w for w in words if splits(w))
lines, line = [], ""
for w in found:
    if len(line) + len(w) > 118:
        lines.append(line)
        line = ""
    line = f"{line} {w}".strip()
open(f"{out}/lookalikes.txt", "w", encoding="utf-8").write("\n".join(lines + [line]) + "\n")
