#!/usr/bin/env python3
"""Makes speech whose times are known, to train the aligner on and to test it with, by espeak-ng.

    apt-get install libespeak-ng1            (version 1.51; numpy for --tests only)
    python3 tests/learn/speech.py OUTDIR [--seconds 2700]
    python3 tests/learn/speech.py --tests OUTDIR

The first writes OUTDIR/zh and OUTDIR/en to train on, OUTDIR/zh-test and OUTDIR/en-test, a fifth, held out: other voices
and other sentences. For each NAME.wav (22050 Hz, 16 bit, one channel, a quarter of a second of silence at both ends)

    NAME.tsv          syllable <TAB> label <TAB> start <TAB> end
    NAME.phones.tsv   syllable <TAB> phone of espeak <TAB> start <TAB> end

where syllables are counted from 0, labels are Hanyu Pinyin with a number for the tone (`nü3`) or English words as they are in
src/script/cmudict.txt, and times are seconds. The same OUTDIR is made on every run.

The second writes recordings like those of the test data `speech/espeak`: its 22 sentences, which are in no training speech,
in voices that are in none, at three speeds, clean and with pink noise at 20 and 10 dB, at 16 kHz, with truth.csv and
phones.csv.

Times are those of espeak's own events, exact to the sample. Its voice `cmn` misreads; `cmn-latn-pinyin` reads every
syllable of syllables.csv rightly but lüan and the interjections without a vowel, which are left out.
"""
import argparse
import csv
import ctypes
import os
import pickle
import random
import wave

HERE = os.path.dirname(os.path.abspath(__file__))
SCRIPT = os.path.join(HERE, "..", "..", "src", "script")
PAD = 0.25

# The voice itself and its variant f3 are those of the test data, so they are in neither list.
TRAINING_VARIANTS = """f1 f2 f4 f5 m1 m2 m3 m4 m5 m7 m8 klatt klatt2 klatt3 Annie belinda linda anika steph michel adam Andy
    Alicia Henrique max antonio zac john marcelo caleb Andrea Hugo Marco Nguyen norbert pablo sandro victor""".split()
HELD_OUT_VARIANTS = "m6 edward aunty shelby Diogo benjamin travis Mario paul miguel Jacky Gene".split()
ENGLISH_VOICES = ["en-us", "en-us", "en", "en-gb-x-rp", "en-gb-scotland", "en-029", "en-gb-x-gbclan", "en-gb-x-gbcwmd"]

# The sentences of the test data; ',' is a pause.
TEST_SENTENCES = """
nin2 hao3
xi1 yang2 hen3 mei3
wo3 shi4 lao3 shi1
jin1 tian1 tian1 qi4 hen3 hao3
ni3 jiao4 shen2 me5 ming2 zi5
wo3 xiang3 he1 yi4 bei1 cha2
qing3 wen4 , huo3 che1 zhan4 zai4 na3 li3
ba4 ba5 mai3 le5 san1 ben3 shu1
ming2 tian1 wo3 men5 qu4 dong4 wu4 yuan2
ta1 bu4 xi3 huan1 chi1 yu2
fei1 ji1 jiu3 dian3 zhong1 qi3 fei1
dui4 bu5 qi3 , wo3 ting1 bu4 dong3
zhe4 ge5 zi4 zen3 me5 xie3
peng2 you3 song4 wo3 yi4 duo3 hua1
chuang1 wai4 xia4 yu3 le5 , ji4 de5 dai4 san3
xiao3 gou3 pao3 de5 fei1 chang2 kuai4
nü3 er2 de5 sheng1 ri4 shi4 qi1 yue4 er4 shi2 hao4
xie4 xie5 , zai4 jian4
xue2 xi2 zhong1 wen2 xu1 yao4 shi2 jian1 he2 nai4 xin1
hong2 deng1 ting2 , lü4 deng1 xing2 , guo4 ma3 lu4 yao4 xiao3 xin1
xiao3 mao1 miao1 miao1 jiao4 , xiang3 yao4 shui4 jiao4
si4 shi4 si4 , shi2 shi4 shi2 , shi2 si4 shi4 shi2 si4
""".strip().splitlines()

# Common words, by what they do in a sentence.
NOUNS = """people year day thing man world life hand part child eye woman place work week case point company number group
    problem fact time water house school teacher book letter river mountain street window door garden table chair paper
    picture music story question answer word language friend family mother father brother sister baby boy girl doctor
    lawyer king queen village city country island bridge station train ship car bicycle airplane ticket money market shop
    bread butter cheese apple orange breakfast lunch dinner kitchen bottle cup knife spoon plate fire snow rain wind sun
    moon star sky cloud storm summer winter spring autumn morning evening night hour minute month dog cat horse bird fish
    sheep mouse bear lion tree flower leaf grass field forest hill valley beach sea lake ocean voice mouth tooth tongue
    nose ear hair head shoulder finger knee foot heart blood bone skin shirt shoe jacket dress hat glove pocket ring
    newspaper magazine computer telephone television camera radio machine engine measure pleasure treasure vision garage
    birthday weather leather feather thought breath health truth path bath mouthful zoo size prize judge bridge village
    college kitchen church watch match beach joy toy boy noise choice coin power tower shower hour flower""".split()
VERBS = """see make take find give tell work call try ask need feel become leave put mean keep let begin seem help show hear
    play run move live believe bring happen write provide sit stand lose pay meet include continue set learn change lead
    understand watch follow stop create speak read allow add spend grow open walk win offer remember love consider appear
    buy wait serve die send expect build stay fall cut reach kill remain suggest raise pass sell require report decide
    pull push catch throw draw choose teach sing swim drive fly drink eat sleep dream laugh cry smile shout whisper jump
    climb wash cook clean paint join enjoy visit measure usually""".split()
QUALITIES = """good new first last long great little own other old right big high different small large next early young
    important few public bad same able red green blue yellow black white brown warm cold hot cool wet dry clean dirty fast
    slow easy hard heavy light dark bright quiet loud soft sharp sweet sour bitter fresh rich poor strong weak thick thin
    deep shallow wide narrow short tall round square empty full happy sad angry proud brave kind gentle clever foolish
    strange familiar beautiful ugly famous modern ancient foreign local simple royal usual smooth through""".split()
SMALL = """the a this that these those my your his her our their some any every no""".split()
BEFORE = """in on at by with from under over behind between before after near without through across around against""".split()
WHO = """i you he she we they it everybody nobody somebody""".split()
HOW = """very quite rather always never often sometimes already still really just almost perhaps only even""".split()
PHRASES = """good morning|how do you do|thank you very much|nice to meet you|what time is it|see you tomorrow|excuse me please|
    i do not understand|can you help me|where is the station|how much is this|have a nice day|the sun was shining|
    once upon a time|as soon as possible|more or less|in the middle|at the same time|the other day|last but not least|
    one two three four five|six seven eight nine ten|monday tuesday wednesday|january february march|which way did they go|
    wrap the cloak around him|blow as hard as you can|the stronger of the two|a traveler came along|she had your dark suit|
    in greasy wash water all year|do not ask me to carry|an oily rag like that|who was the first to speak|
    that is what i was going to say|why would anybody want it|would you like a cup of tea|he could not have been there""".split("|")


class Event(ctypes.Structure):
    class Id(ctypes.Union):
        _fields_ = [("number", ctypes.c_int), ("name", ctypes.c_char_p), ("string", ctypes.c_char * 8)]

    _fields_ = [("type", ctypes.c_int), ("unique_identifier", ctypes.c_uint), ("text_position", ctypes.c_int),
                ("length", ctypes.c_int), ("audio_position", ctypes.c_int), ("sample", ctypes.c_int),
                ("user_data", ctypes.c_void_p), ("id", Id)]


class Espeak:
    """The library, speaking into memory. Events: 1 a word begins, 7 a phone begins."""
    RATE, PITCH, RANGE = 1, 3, 4

    def __init__(self):
        self.library = ctypes.CDLL("libespeak-ng.so.1")
        self.sound, self.events = [], []
        kind = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(ctypes.c_short), ctypes.c_int, ctypes.POINTER(Event))
        self.callback = kind(self.hear)
        self.rate = 22050

    def hear(self, samples, count, events):
        if samples and count > 0:
            self.sound.append(ctypes.string_at(samples, 2 * count))
        i = 0
        while events[i].type:
            event = events[i]
            if event.type == 1:
                self.events.append((event.sample, "word", event.text_position))
            elif event.type == 7:
                self.events.append((event.sample, "phone", bytes(event.id.string).split(b"\0")[0].decode("utf-8", "replace")))
            i += 1
        return 0

    def say(self, *what):
        """As `speak`, in a process of its own: some of its voices (rob) crash."""
        from_child, to_parent = os.pipe()
        child = os.fork()
        if child == 0:
            os.close(from_child)
            with os.fdopen(to_parent, "wb") as pipe:
                pickle.dump(self.speak(*what), pipe)
            os._exit(0)
        os.close(to_parent)
        with os.fdopen(from_child, "rb") as pipe:
            answer = pipe.read()
        if os.waitpid(child, 0)[1] != 0:
            raise SystemExit(f"espeak-ng failed at {what}")
        return pickle.loads(answer)

    def speak(self, words, voice, speed, pitch, spread=50):
        """Sound as bytes, and for each word that is no comma its phones as (name, start, end) in seconds; None where
        espeak ran words together."""
        self.sound, self.events = [], []
        if self.library.espeak_Initialize(2, 0, None, 1) != self.rate:
            raise SystemExit("espeak-ng does not begin, or not at 22050 Hz")
        self.library.espeak_SetSynthCallback(self.callback)
        if self.library.espeak_SetVoiceByName(voice.encode()) != 0:
            raise SystemExit(f"espeak-ng has no voice {voice}")
        for what, value in ((self.RATE, speed), (self.PITCH, pitch), (self.RANGE, spread)):
            self.library.espeak_SetParameter(what, value, 0)
        text = " ".join(words).replace(" ,", ",") + "."
        places, at = {}, 0
        said = [w for w in words if w != ","]
        for number, word in enumerate(said):
            at = text.index(word, at)
            places[at + 1] = number
            at += len(word)
        raw = text.encode()
        self.library.espeak_Synth(raw, len(raw) + 1, 0, 1, 0, 1, None, None)
        sound = b"".join(self.sound)
        timed, here = [], None
        for sample, kind, what in self.events:
            if kind == "word":
                here = places.get(what, here)
            else:
                timed.append((sample, what, here))
        timed.append((len(sound) // 2, "_", None))
        phones = [[] for _ in said]
        for (start, name, word), (end, _, _) in zip(timed, timed[1:]):
            if word is not None and end > start and not name.startswith("_"):
                phones[word].append((name, start / self.rate, end / self.rate))
        return (sound, phones) if all(phones) else None


def write(folder, name, rate, sound, labels, phones):
    silence = bytes(2 * int(PAD * rate))
    with wave.open(os.path.join(folder, name + ".wav"), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(rate)
        file.writeframes(silence + sound + silence)
    pad = int(PAD * rate) / rate
    with open(os.path.join(folder, name + ".tsv"), "w", encoding="utf-8") as file:
        for i, (label, inside) in enumerate(zip(labels, phones)):
            file.write(f"{i}\t{label}\t{inside[0][1] + pad:.4f}\t{inside[-1][2] + pad:.4f}\n")
    with open(os.path.join(folder, name + ".phones.tsv"), "w", encoding="utf-8") as file:
        for i, inside in enumerate(phones):
            for phone, start, end in inside:
                file.write(f"{i}\t{phone}\t{start + pad:.4f}\t{end + pad:.4f}\n")


def mandarin_syllables():
    rows = [r.split(",") for r in open(os.path.join(SCRIPT, "syllables.csv"), encoding="utf-8").read().splitlines()[1:]]
    once = sorted({r[0] for r in rows if r[5] != "interj"} - {"lüan", "m", "n", "ng", "hm", "hng", "r"})
    # Of vowels that are in few syllables of the table but in many of a text there must be enough to learn from.
    return once + 3 * "zhi chi shi ri zi ci si er yu ju qu xu nü lü yun e yi wu".split()


def mandarin(random, bag, syllables):
    """4 to 12 syllables at random, out of a bag that holds each as often as `mandarin_syllables`."""
    words = []
    count = random.randint(4, 12)
    for i in range(count):
        if not bag:
            bag.extend(random.sample(syllables, len(syllables)))
        words.append(bag.pop() + random.choice("123412345"))
        if i < count - 1 and random.random() < 0.12:
            words.append(",")
    return words


def english(random, bag, known):
    """A phrase, or clauses made of common words, each as often as the others of its kind."""
    def pick(kind, words):
        if not bag.get(kind):
            bag[kind] = random.sample(words, len(words))
        return bag[kind].pop()

    def thing():
        return [random.choice(SMALL)] + ([pick("how", HOW)] if random.random() < 0.15 else []) \
            + ([pick("quality", QUALITIES)] if random.random() < 0.6 else []) + [pick("noun", NOUNS)]

    def clause():
        who = [random.choice(WHO)] if random.random() < 0.3 else thing()
        how = [pick("how", HOW)] if random.random() < 0.3 else []
        where = [random.choice(BEFORE)] + thing() if random.random() < 0.5 else []
        return who + how + [pick("verb", VERBS)] + (thing() if random.random() < 0.7 else []) + where

    draw = random.random()
    if draw < 0.2:
        words = random.choice(PHRASES).split()
    elif draw < 0.4:
        words = [pick("any", sorted(set(NOUNS + VERBS + QUALITIES))) for _ in range(random.randint(3, 7))]
    elif draw < 0.8:
        words = clause()
    else:
        words = clause() + [",", random.choice(["and", "but", "because", "when", "if"])] + clause()
    assert all(w == "," or w in known for w in words), words
    return words


def known_english():
    """The words of cmudict.txt; its form is told in english.py."""
    words, before = set(), ""
    for line in open(os.path.join(SCRIPT, "cmudict.txt"), encoding="utf-8").read().splitlines():
        if line:
            shared, _ = line.split(" ")
            before = before[: ord(shared[0]) - 97] + shared[1:]
            words.add(before)
        else:
            before = ""
    return words


def training(espeak, out, seconds):
    known, syllables = known_english(), mandarin_syllables()
    heldout_sentences = {s.replace(" ,", "") for s in TEST_SENTENCES}
    seen = set()
    for kind, share in (("zh", 0.48), ("zh-test", 0.12), ("en", 0.32), ("en-test", 0.08)):
        folder = os.path.join(out, kind)
        os.makedirs(folder, exist_ok=True)
        dice = random.Random(f"lianpu {kind}")
        variants = HELD_OUT_VARIANTS if kind.endswith("test") else TRAINING_VARIANTS
        bag = [] if kind.startswith("zh") else {}
        done, number, used = 0.0, 0, set()
        while done < share * seconds:
            zh = kind.startswith("zh")
            words = mandarin(dice, bag, syllables) if zh else english(dice, bag, known)
            variant = dice.choice(variants)
            base = "cmn-latn-pinyin" if zh else dice.choice(ENGLISH_VOICES)
            speed, pitch, spread = dice.randint(115, 230), dice.randint(20, 85), dice.randint(20, 80)
            sentence = " ".join(words)
            if sentence in seen or sentence.replace(" ,", "") in heldout_sentences:
                continue
            said = espeak.say(words, f"{base}+{variant}", speed, pitch, spread)
            if said is None:
                continue
            used.add(sentence)
            sound, phones = said
            write(folder, f"{number:04}", espeak.rate, sound, [w for w in words if w != ","], phones)
            done += len(sound) / 2 / espeak.rate
            number += 1
        # A phrase may come again in another voice, but not in what is held out.
        seen |= used
        print(f"{kind}: {number} recordings, {done:.0f} s")


def tests(espeak, out):
    import numpy

    os.makedirs(out, exist_ok=True)
    rate = 16000
    noise = numpy.random.default_rng(4)

    def resampled(samples):
        count = len(samples) * rate // espeak.rate
        spectrum = numpy.fft.rfft(samples)
        # The last eighth of the band is faded so that it does not ring.
        kept = spectrum[: count // 2 + 1] * numpy.clip((1 - numpy.arange(count // 2 + 1) / (count / 2)) * 8, 0, 1)
        return numpy.fft.irfft(kept, count) * (count / len(samples))

    def pink(count):
        spectrum = numpy.fft.rfft(noise.standard_normal(count))
        shaped = numpy.fft.irfft(spectrum / numpy.sqrt(numpy.maximum(numpy.arange(len(spectrum)) * rate / count, 20)), count)
        return shaped / numpy.sqrt((shaped ** 2).mean())

    truth, inside = [], []
    for number, sentence in enumerate(TEST_SENTENCES, 1):
        words = sentence.split()
        labels = [w for w in words if w != ","]
        for tag, variant in (("m0", ""), ("f3", "+f3"), ("m6", "+m6")):
            for speed in (110, 150, 190):
                said = espeak.say(words, "cmn-latn-pinyin" + variant, speed, 50)
                if said is None:
                    continue
                sound, phones = said
                silence = numpy.zeros(int(0.3 * espeak.rate))
                clean = resampled(numpy.concatenate([silence, numpy.frombuffer(sound, "<i2").astype(float), silence]))
                speech = numpy.concatenate([clean[int((p[0][1] + 0.3) * rate):int((p[-1][2] + 0.3) * rate)] for p in phones])
                loud = numpy.sqrt((speech ** 2).mean())
                for snr in ("clean", "20", "10"):
                    name = f"s{number:02}_{tag}_{speed}" + ("" if snr == "clean" else f"_snr{snr}")
                    mixed = clean if snr == "clean" else 0.9 * (clean + pink(len(clean)) * loud / 10 ** (float(snr) / 20))
                    with wave.open(os.path.join(out, name + ".wav"), "wb") as file:
                        file.setnchannels(1)
                        file.setsampwidth(2)
                        file.setframerate(rate)
                        file.writeframes(numpy.clip(numpy.round(mixed), -32768, 32767).astype("<i2").tobytes())
                    for i, (label, part) in enumerate(zip(labels, phones)):
                        truth.append([name, i, "", label, f"{part[0][1] + 0.3:.4f}", f"{part[-1][2] + 0.3:.4f}", snr])
                        inside += [[name, i, label, p, f"{a + 0.3:.4f}", f"{b + 0.3:.4f}"] for p, a, b in part]
    for name, head, rows in (("truth", "file,idx,hanzi,pinyin,start,end,snr", truth), ("phones", "file,idx,pinyin,phone,start,end", inside)):
        with open(os.path.join(out, name + ".csv"), "w", newline="", encoding="utf-8") as file:
            csv.writer(file, lineterminator="\n").writerows([head.split(","), *rows])
    print(f"{len({r[0] for r in truth})} recordings")


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("out")
    options.add_argument("--seconds", type=float, default=2700.0)
    options.add_argument("--tests", action="store_true")
    given = options.parse_args()
    if given.tests:
        tests(Espeak(), given.out)
    else:
        training(Espeak(), given.out, given.seconds)


if __name__ == "__main__":
    main()
