#!/usr/bin/env python3
"""Makes src/script/readings.txt, simplified.txt and words.txt from openly licensed dictionaries.

    pip download --no-deps --no-binary jieba -d DIR pypinyin==0.55.0 jieba==0.42.1 opencc-python-reimplemented==0.1.7
    (cd DIR && npm pack pinyin-pro@3.29.4)
    python3 tests/learn/mandarin.py DIR src/script

What it takes: readings of characters and words from pypinyin (MIT) and pinyin-pro (MIT), how common words are from
jieba (MIT), traditional and simplified forms from OpenCC's tables (Apache-2.0), and by-hand.txt beside this script, which
holds what dictionaries of words cannot say: surnames, place names, patterns of grammar. No sentence with readings is
learned from.

How: a character's first reading is the one that most of its words have, unless by-hand.txt says otherwise. Then words are gone
through from the short to the long, and a word is listed only where what is already there reads it wrong.
"""
import collections
import glob
import io
import json
import re
import sys
import tarfile
import unicodedata
import zipfile

MARKS = {"\u0304": 1, "\u0301": 2, "\u030c": 3, "\u0300": 4}
NUMBERS = set("〇零一二三四五六七八九十百千万亿几两半多数")
SIGNS = set("#^$~=")
LONGEST = 6


def plain(syllable):
    """hǎo → hao3, with 5 for no mark."""
    tone, out = 5, ""
    for c in unicodedata.normalize("NFD", syllable.strip().lower().replace("ɡ", "g")):
        if c in MARKS:
            tone = MARKS[c]
        elif c == "\u0308":
            out = out[:-1] + "ü"
        elif c == "\u0302":
            out = out[:-1] + "ê"
        else:
            out += c
    return f"{out}{tone}"


class Packages:
    def __init__(self, folder):
        self.folder = folder

    def one(self, pattern):
        return sorted(glob.glob(f"{self.folder}/{pattern}"))[-1]

    def zipped(self, package, name):
        with zipfile.ZipFile(self.one(package)) as z:
            return z.read(next(n for n in z.namelist() if n.endswith(name))).decode()

    def tarred(self, package, name):
        with tarfile.open(self.one(package)) as t:
            member = next(m for m in t.getmembers() if m.name.endswith(name))
            return io.TextIOWrapper(t.extractfile(member), "utf-8").read()


def known_sounds(folder):
    rows = open(f"{folder}/syllables.csv", encoding="utf-8").read().splitlines()[1:]
    return {r.split(",")[0] for r in rows}


def tidy(word, readings, sounds):
    """Dictionary tones: 一 and 不 without sandhi; the suffix of erhua as r5; nothing where a syllable is unknown."""
    out = []
    for i, (c, r) in enumerate(zip(word, readings)):
        if c == "一":
            r = "yi1"
        if c == "不" and r[:-1] == "bu":
            r = "bu4"
        if c in "儿兒" and (r[:-1] == "r" or (r == "er5" and i > 0)):
            r = "r5"
        if r[:-1] not in sounds:
            return None
        out.append(r)
    return out


def is_han(c):
    return c == "〇" or "\u3400" <= c <= "\u9fff" or "\U00020000" <= c <= "\U0003ffff"


def load_words(p, sounds):
    """Words with readings, the better source last."""
    words = {}
    for w, rs in json.loads(p.zipped("pypinyin-*.whl", "pypinyin/phrases_dict.json")).items():
        words[w] = [plain(r[0]) for r in rs]
    for n in "2345":
        text = p.tarred("pinyin-pro-*.tgz", f"esm/data/dict{n}.mjs")
        for w, rs in re.findall(r"""^\s*["']?([^\s"':]+)["']?:\s*["']([^"']+)["'],?\s*$""", text, re.M):
            words[w] = [plain(r) for r in rs.split()]
    out = {}
    for w, rs in words.items():
        if len(w) == len(rs) and 1 < len(w) <= LONGEST and all(map(is_han, w)):
            rs = tidy(w, rs, sounds)
            if rs:
                out[w] = rs
    return out


def load_chars(p, sounds):
    """All readings of a character, pinyin-pro's order first: it goes by use."""
    pro = {}
    text = p.tarred("pinyin-pro-*.tgz", "esm/data/dict1.mjs")
    for rs, cs in re.findall(r"""^\s*["']?([^"':\n]+?)["']?:\s*\[([^\]]*)\]""", text, re.M):
        for c in re.findall(r"'([^']+)'", cs):
            pro[c] = [plain(r) for r in rs.split()]
    chars = {}
    for code, rs in json.loads(p.zipped("pypinyin-*.whl", "pypinyin/pinyin_dict.json")).items():
        chars[chr(int(code))] = [plain(r) for r in rs.split(",")]
    for c, rs in pro.items():
        chars[c] = rs + [r for r in chars.get(c, []) if r not in rs]
    out = {}
    for c, rs in chars.items():
        rs = list(dict.fromkeys(r for r in rs if r[:-1] in sounds))
        if rs and is_han(c):
            out[c] = rs
    return out


def load_by_hand(path):
    """Lines `字 reading: words`, and `字 reading` alone for a first reading."""
    first, listed = {}, collections.defaultdict(list)
    for line in open(path, encoding="utf-8"):
        line = line.split("//")[0].strip()
        if not line:
            continue
        head, colon, words = line.partition(":")
        c, reading = head.split()
        if not colon:
            first[c] = reading
        for w in words.split():
            listed[c, reading].append(w)
    return first, listed


class Words:
    """The list as the program reads it: the heaviest word around a character decides."""

    def __init__(self, first):
        self.first = first
        self.lines = collections.defaultdict(dict)

    def add(self, c, word, reading):
        self.lines[c].setdefault(word, reading)

    def weigh(self, word, text, start, at):
        i, weight = start, 0
        for s in word:
            if s in "*?":
                continue
            if s == "^":
                if i > 0 and is_han(text[i - 1]):
                    return None
                weight += 1
                continue
            here = text[i] if 0 <= i < len(text) else None
            if s == "$":
                ok = here is None or not is_han(here)
            elif s == "~":
                ok = here is not None and is_han(here)
            elif s == "=":
                ok = here is not None and i > 0 and text[i - 1] == here
            elif s == "#":
                ok = here in NUMBERS
            else:
                ok = i == at or here == s
            if not ok:
                return None
            weight += 1 if s in SIGNS else 4
            i += 1
        return 2 if word[0] == "?" else weight

    def read(self, text, at):
        c = text[at]
        best, reading = -1, self.first.get(c)
        for word, r in self.lines.get(c, {}).items():
            offset, previous = 0, ""
            for s in word:
                if s == c and ("*" not in word or previous == "*") and at >= offset:
                    weight = self.weigh(word, text, at - offset, at)
                    if weight is not None and weight > best:
                        best, reading = weight, r
                previous = s
                offset += s not in "*^?"
        return reading


def chance(word, frequency, total):
    """How often the characters of a word stand side by side as two words, by chance: 面的 is far more often 面 and 的."""
    halves = [(word[:i], word[i:]) for i in range(1, len(word))]
    return max(frequency.get(a, 0) * frequency.get(b, 0) / total for a, b in halves)


def main():
    folder, out = sys.argv[1], sys.argv[2]
    p = Packages(folder)
    sounds = known_sounds(out)
    words, chars = load_words(p, sounds), load_chars(p, sounds)
    first_by_hand, listed = load_by_hand(__file__.rsplit("/", 1)[0] + "/by-hand.txt")
    frequency, tags = {}, {}
    for line in p.tarred("jieba-*.tar.gz", "jieba/dict.txt").splitlines():
        w, f, *tag = line.split()
        frequency[w], tags[w] = int(f), "".join(tag)

    pairs = {}
    for line in p.zipped("opencc_python_reimplemented-*.whl", "TSCharacters.txt").splitlines():
        a, b = line.split("\t")
        if b.split()[0] != a and is_han(a):
            pairs[a] = b.split()[0]
    # Simplified characters that stand for one traditional character only.
    alone = {}
    for line in p.zipped("opencc_python_reimplemented-*.whl", "STCharacters.txt").splitlines():
        a, b = line.split("\t")
        if len(b.split()) == 1:
            alone[a] = b
    simple = lambda w: "".join(pairs.get(c, c) for c in w)

    # The first reading: what most words say that are in use.
    votes = collections.defaultdict(collections.Counter)
    for w, rs in words.items():
        if len(w) <= 4 and frequency.get(w, 0) > 2:
            for c, r in set(zip(w, rs)):
                votes[c][r] += 1
    first = {}
    for c, rs in chars.items():
        first[c] = rs[0]
        if votes[c] and len(rs) > 1:
            # A neutral tone is a word's, not a character's.
            full = collections.Counter({r: n for r, n in votes[c].items() if r[-1] != "5"})
            if full and rs[0][-1] != "5":
                r, n = full.most_common(1)[0]
                if n >= 3 and n > 2 * full[rs[0]]:
                    first[c] = r
    first.update(first_by_hand)
    # A traditional character that alone stands for its simplified one has that one's first reading; of several that
    # share a simplified form each has its own.
    for t, s in pairs.items():
        if t in first_by_hand or s not in first:
            continue
        if alone.get(s) == t:
            first[t] = first[s]
            chars.setdefault(t, [first[s]])
            chars[t] += [r for r in chars.get(s, ()) if r not in chars[t]]
        elif s in first_by_hand and first[s] in chars.get(t, ()):
            first[t] = first[s]

    # 地 after what is said of how something is done; any word that 地 begins is heavier.
    for w, tag in tags.items():
        if tag in ("ad", "d", "z", "a", "i") and len(w) in (2, 3, 4) and frequency[w] >= (100 if tag != "i" else 60):
            if all(map(is_han, w)) and "地" not in w:
                listed["地", "de5"].append("?" + w + "地")
    for w in sorted(frequency, key=lambda w: -frequency[w]):
        if w[0] == "地" and len(w) == 2 and is_han(w[1]) and frequency[w] >= 100:
            listed["地", "di4"].append(w)

    table = Words(first)
    for (c, reading), ws in listed.items():
        for w in ws:
            assert c in w, (c, w)
            table.add(c, w, reading)
    total, skipped = sum(frequency.values()), []
    order = sorted(words, key=lambda w: (len(w), -frequency.get(w, 0), w))
    for w in order:
        if chance(w, frequency, total) > max(frequency.get(w, 0), 1):
            skipped.append(w)
            continue
        if len(w) > 4 and frequency.get(w, 0) == 0:
            continue
        for at, (c, r) in enumerate(zip(w, words[w])):
            key = w if at == 0 or c not in w[:at] + w[at + 1 :] else w[:at] + "*" + w[at:]
            key = key if w.count(c) == 1 else w[:at] + "*" + w[at:]
            neighbours = simple(w[:at]) + c + simple(w[at + 1 :])
            if table.read(neighbours, at) != r:
                key = simple(key[: key.index(c, at)]) + c + simple(key[key.index(c, at) + 1 :])
                table.add(c, key, r)

    by_line = collections.defaultdict(list)
    for c, ws in table.lines.items():
        for w, r in ws.items():
            by_line[c, r].append(w)
    with open(f"{out}/words.txt", "w", encoding="utf-8") as f:
        for (c, r), ws in sorted(by_line.items()):
            f.write(f"{c}\t{r}\t{' '.join(sorted(set(ws)))}\n")

    # Readings a word needs are readings the character has.
    for (c, r) in by_line:
        if c in chars and r not in chars[c]:
            chars[c].append(r)
    for t, s in pairs.items():
        if alone.get(s) == t and t in chars:
            chars[t] += [r for r in chars.get(s, ()) if r not in chars[t]]
    firsts, others = collections.defaultdict(list), collections.defaultdict(list)
    for c, rs in chars.items():
        firsts[first[c]].append(c)
        for r in rs:
            if r != first[c]:
                others[r].append(c)
    with open(f"{out}/readings.txt", "w", encoding="utf-8") as f:
        for r in sorted(set(firsts) | set(others)):
            f.write(f"{r}\t{''.join(sorted(firsts[r]))}\t{''.join(sorted(others[r]))}\n")
    with open(f"{out}/simplified.txt", "w", encoding="utf-8") as f:
        for a, b in sorted(pairs.items()):
            if "\u3400" <= a <= "\u9fff" and "\u3400" <= b <= "\u9fff":
                f.write(a + b + "\n")
    if "-v" in sys.argv:
        print(" ".join(skipped))


main()
