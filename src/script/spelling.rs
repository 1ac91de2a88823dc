//! English spelling to sound for words that no dictionary has: the longest group of letters that fits decides.

use super::phone::Phone;

/// Letters and their phones. `^` is the start of the word, `$` its end; what stands in `[ ]` must follow and is not read.
/// Longer groups stand before the shorter ones they begin with; a final silent e is `Ce`'s to say.
const RULES: &str = "
^kn=N ^gn=N ^wr=R ^ps=S ^x=Z ^wh=W ^rh=R ^mc=M AH K ^y=Y ^sch=S K
tion=SH AH N sion=ZH AH N cian=SH AH N tious=SH AH S cious=SH AH S tial=SH AH L cial=SH AH L ture=CH ER sure=ZH ER
ight=AY T eigh=EY ough=AO augh=AO aught=AO T igh=AY tch=CH dge=JH sch=SH
ing$=IH NG ings$=IH NG Z ed$=D es$=Z ies$=IY Z ous$=AH S ful$=F AH L le$=AH L ly$=L IY ty$=T IY
able$=AH B AH L ness$=N AH S less$=L AH S ment$=M AH N T
air=EH R ear=IH R eer=IH R oar=AO R oor=AO R our=AW R ier=IY ER are$=EH R ere$=IH R ire$=AY ER ore$=AO R ure$=Y UH R
ar=AA R er=ER ir=ER or=AO R ur=ER yr=IH R
ai=EY ay=EY au=AO aw=AO al[k]=AO ee=IY ea=IY ei=EY ey$=IY ey=EY eu=Y UW ew=Y UW ie$=AY ie=IY oa=OW oe$=OW oe=OW
oi=OY oy=OY oo=UW ou=AW ow$=OW ow=AW ue$=UW ui=UW
ch=CH ck=K gh=G ph=F qu=K W sh=SH th=TH wh=W ng$=NG ng[k]=NG nk=NG K mb$=M mn$=M gn$=N
sc[e]=S sc[i]=S sc[y]=S ss=S tt=T bb=B dd=D ff=F gg=G ll=L mm=M nn=N pp=P rr=R zz=Z cc[e]=K S cc[i]=K S cc=K
ce$=S ge$=JH se$=Z ve$=V ze$=Z
c[e]=S c[i]=S c[y]=S g[e]=JH g[i]=JH g[y]=JH
e$= a$=AH i$=IY o$=OW u$=UW y$=IY y=IH
a=AE b=B c=K d=D e=EH f=F g=G h=HH i=IH j=JH k=K l=L m=M n=N o=AA p=P q=K r=R s$=Z s=S t=T u=AH v=V w=W x=K S z=Z
";

/// Whether a word has a letter that can carry a syllable.
pub(super) fn has_vowel(word: &str) -> bool {
    word.contains(['a', 'e', 'i', 'o', 'u', 'y'])
}

/// The phones of a word in lower-case letters.
pub(super) fn say(word: &str) -> Vec<Phone> {
    let rules = rules();
    let mut out = Vec::new();
    let mut at = 0;
    while at < word.len() {
        if let Some(vowel) = long_before_silent_e(word, at) {
            out.extend(parse(vowel));
            at += 1;
            continue;
        }
        let fitting = rules.iter().filter(|r| r.fits(word, at));
        // The longest group wins; of two the one that says more about its place.
        match fitting.max_by_key(|r| (r.letters.len(), r.asks())) {
            Some(rule) => {
                out.extend(parse(rule.phones));
                at += rule.letters.len();
            }
            None => at += 1,
        }
    }
    out
}

/// A vowel before one consonant and a final e says its name: mate, mite, mote, mute.
fn long_before_silent_e(word: &str, at: usize) -> Option<&'static str> {
    let rest = word.as_bytes().get(at..)?;
    let [vowel, consonant, b'e'] = rest else { return None };
    if b"aeiouwxy".contains(consonant) || (at > 0 && b"aeiou".contains(&word.as_bytes()[at - 1])) {
        return None;
    }
    match vowel {
        b'a' => Some("EY"),
        b'e' => Some("IY"),
        b'i' | b'y' => Some("AY"),
        b'o' => Some("OW"),
        b'u' => Some("UW"),
        _ => None,
    }
}

fn parse(phones: &str) -> impl Iterator<Item = Phone> {
    phones.split(' ').filter_map(|p| p.parse().ok())
}

struct Rule {
    letters: &'static str,
    phones: &'static str,
    start: bool,
    end: bool,
    next: &'static str,
}

impl Rule {
    fn fits(&self, word: &str, at: usize) -> bool {
        let Some(rest) = word.get(at..).and_then(|w| w.strip_prefix(self.letters)) else { return false };
        (!self.start || at == 0) && (!self.end || rest.is_empty()) && rest.starts_with(self.next)
    }

    fn asks(&self) -> usize {
        usize::from(self.start) + usize::from(self.end) + self.next.len()
    }
}

/// The rules as written above. A rule's phones run to the next word with a `=`.
fn rules() -> Vec<Rule> {
    let mut rules = Vec::new();
    for line in RULES.lines() {
        let starts: Vec<usize> = line
            .char_indices()
            .filter(|(i, _)| *i == 0 || line.as_bytes()[i - 1] == b' ')
            .filter(|(i, _)| line[*i..].split(' ').next().is_some_and(|w| w.contains('=')))
            .map(|(i, _)| i)
            .collect();
        for (k, start) in starts.iter().enumerate() {
            let end = starts.get(k + 1).copied().unwrap_or(line.len());
            let Some((letters, phones)) = line[*start..end].trim_end().split_once('=') else { continue };
            let (letters, next) = match letters.split_once('[') {
                Some((letters, next)) => (letters, next.trim_end_matches(']')),
                None => (letters, ""),
            };
            let (start, end) = (letters.starts_with('^'), letters.ends_with('$'));
            rules.push(Rule { letters: letters.trim_matches(['^', '$']), phones, start, end, next });
        }
    }
    rules
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(word: &str) -> String {
        say(word).iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn common_spellings_are_read_as_they_are_meant() {
        for (word, want) in [
            ("zate", "Z EY T"),
            ("knabble", "N AE B AH L"),
            ("phlation", "F L AE SH AH N"),
            ("quinching", "K W IH N CH IH NG"),
            ("cepy", "S EH P IY"),
            ("thrudge", "TH R AH JH"),
        ] {
            assert_eq!(said(word), want, "{word}");
        }
    }
}
