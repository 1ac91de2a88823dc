//! Text in markup.

use std::fmt::{Display, Formatter, Result, Write};

/// Text safe inside elements and quoted attributes of XML and HTML. What XML cannot hold (XML 1.0, production 2) is left
/// out, and so are control characters but newline and tab.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Escaped<'a>(pub &'a str);

impl Display for Escaped<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        for c in self.0.chars() {
            match c {
                '&' => f.write_str("&amp;")?,
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                '"' => f.write_str("&quot;")?,
                '\u{FFFE}' | '\u{FFFF}' => {}
                c if c.is_control() && !matches!(c, '\n' | '\t') => {}
                c => f.write_char(c)?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cannot_break_out_of_its_place() {
        assert_eq!(Escaped("<a b=\"&\">").to_string(), "&lt;a b=&quot;&amp;&quot;&gt;");
    }

    #[test]
    fn whatever_is_written_is_well_formed() {
        let mut all: String = (0..=0x1_FFFF).filter_map(char::from_u32).collect();
        all.push('\u{10FFFF}');
        let text = format!("<?xml version=\"1.0\"?>\n<a b=\"{0}\">{0}</a>", Escaped(&all));
        let read = roxmltree::Document::parse(&text).unwrap();
        let found = read.root_element().text().unwrap();
        assert!(found.contains("!\"#$%&'()") && found.ends_with('\u{10FFFF}'));
        assert_eq!(read.root_element().attribute("b").unwrap().chars().count(), found.chars().count());
    }
}
