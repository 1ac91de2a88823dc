//! Numbers as they are read in Mandarin: a row of characters for a row of digits.
//!
//! How the characters are read is for `words`.

use super::{Number, Sign};

const DIGITS: [char; 10] = ['零', '一', '二', '三', '四', '五', '六', '七', '八', '九'];

/// The characters of a number; `before` is the character before it in its phrase.
pub(in super::super) fn read(number: &Number, before: Option<char>) -> String {
    let (before, sign) = (before.filter(|_| !number.negative), if number.negative { "负" } else { "" });
    let words = match number.sign {
        Some(Sign::Percent) => format!("百分之{}", plain(number, None, None)),
        Some(Sign::Permille) => format!("千分之{}", plain(number, None, None)),
        Some(Sign::Degree) => format!("{}度", plain(number, None, Some('度'))),
        Some(Sign::Celsius) => format!("{}摄氏度", plain(number, None, Some('摄'))),
        Some(Sign::Fahrenheit) => format!("{}华氏度", plain(number, None, Some('华'))),
        None => plain(number, before, number.next.filter(|_| number.money.is_none())),
    };
    let unit = match number.money {
        Some('$') => "美元",
        Some('€') => "欧元",
        Some('£') => "英镑",
        // ¥3万 is 三万元: the unit waits for its number to end.
        Some(_) if !matches!(number.next, Some('万' | '亿' | '萬' | '億' | '元')) => "元",
        _ => "",
    };
    format!("{sign}{words}{unit}")
}

/// The characters of a unit in Latin letters after a number.
pub(in super::super) fn unit(letters: &str) -> Option<&'static str> {
    Some(match letters {
        "km" => "公里",
        "m" => "米",
        "cm" => "厘米",
        "mm" => "毫米",
        "kg" => "公斤",
        "g" => "克",
        "mg" => "毫克",
        "l" | "L" => "升",
        "ml" | "mL" => "毫升",
        "km/h" => "公里每小时",
        _ => return None,
    })
}

/// The characters of its digits; `next` is the character after them.
fn plain(number: &Number, before: Option<char>, next: Option<char>) -> String {
    let joined_by = |c| number.is_joined_by(c);
    match number.parts().as_slice() {
        [one] => amount(one, before, next),
        [y, m, d] if (joined_by('-') || joined_by('/')) && y.len() == 4 && is_date(m, d) => {
            format!("{}年{}月{}日", one_by_one(y), cardinal(m), cardinal(d))
        }
        [h, m, rest @ ..] if joined_by(':') && rest.len() < 2 && is_time(h, m) => {
            let hour = if *h == "2" { "两".to_owned() } else { cardinal(h) };
            let mut said = format!("{hour}点");
            if *m != "00" || !rest.is_empty() {
                said += &format!("{}分", two_places(m));
            }
            rest.iter().for_each(|s| said += &format!("{}秒", two_places(s)));
            said
        }
        [a, b] if joined_by(':') => format!("{}比{}", amount(a, None, None), amount(b, None, None)),
        [a, b] if joined_by('/') && is_date(a, b) && !(a.len() == 1 && b.len() == 1 && a < b) => {
            format!("{}月{}日", cardinal(a), cardinal(b))
        }
        [a, b] if joined_by('/') => format!("{}分之{}", amount(b, None, None), amount(a, None, None)),
        [a, b] if !a.starts_with('0') && !b.starts_with('0') && (a.len() + b.len() < 8 || years(a, b)) => {
            // Years stay years on both sides of the dash: 1990-1995年.
            let years = years(a, b) && next == Some('年');
            let side = |n: &str| if years { one_by_one(n) } else { amount(n, None, None) };
            format!("{}到{}", side(a), amount(b, None, next))
        }
        _ => one_by_one(&number.body),
    }
}

/// Whether both sides of a dash can be years.
fn years(a: &str, b: &str) -> bool {
    [a, b].iter().all(|n| n.len() == 4 && n.starts_with(['1', '2'])) && a < b
}

/// A number without dashes, slashes and colons: whole, decimal, or a row of digits with points.
fn amount(text: &str, before: Option<char>, next: Option<char>) -> String {
    let plain: String = text.chars().filter(|c| *c != ',').collect();
    match plain.split('.').collect::<Vec<_>>().as_slice() {
        [whole] => {
            let year = next == Some('年') && (3..=4).contains(&whole.len());
            // A telephone number or a code, unless thousands or what is counted say otherwise.
            let counted = next.is_some_and(counts) || text.contains(',') || whole.ends_with("0000");
            let row = whole.len() >= 7 && !counted;
            if year || row || (whole.len() > 1 && whole.starts_with('0')) || whole.len() > 16 {
                one_by_one(whole)
            } else if *whole == "2" && before != Some('第') && next.is_some_and(counts) {
                "两".to_owned()
            } else {
                cardinal(whole)
            }
        }
        [y, m, d] if y.len() == 4 && is_date(m, d) => {
            format!("{}年{}月{}日", one_by_one(y), cardinal(m), cardinal(d))
        }
        [whole, rest @ ..] => {
            let mut said = cardinal(whole);
            for part in rest {
                said.push('点');
                said += &one_by_one(part);
            }
            said
        }
        [] => String::new(),
    }
}

/// Whether a character after a number is what is counted: two of it is 两.
fn counts(c: char) -> bool {
    "个個只隻条條张張位次天年本件家座辆輛台部把块塊名人种種点點元斤米岁歲层層句首遍倍小周星杯瓶碗双雙对對口间間颗顆棵朵\
     匹头頭群班排份封支枝根片粒篇项項样樣股架艘栋棟盏盞幅套组組批场場滴步代手边邊侧側千万亿萬億公平立厘毫吨噸克升所"
        .contains(c)
}

fn is_date(month: &str, day: &str) -> bool {
    let within = |text: &str, most: u32| text.len() <= 2 && text.parse::<u32>().is_ok_and(|n| (1..=most).contains(&n));
    within(month, 12) && within(day, 31)
}

fn is_time(hour: &str, minute: &str) -> bool {
    hour.len() <= 2
        && minute.len() == 2
        && hour.parse::<u32>().is_ok_and(|h| h <= 24)
        && minute.parse::<u32>().is_ok_and(|m| m < 60)
}

/// Minutes and seconds: 05 is 零五.
fn two_places(text: &str) -> String {
    match text.strip_prefix('0') {
        Some(rest) if !rest.is_empty() && rest != "0" => format!("零{}", cardinal(rest)),
        _ => cardinal(text),
    }
}

/// Digit by digit.
fn one_by_one(text: &str) -> String {
    text.chars().filter_map(|c| c.to_digit(10)).map(|d| DIGITS[d as usize]).collect()
}

/// A whole number below 10¹⁶: groups of four digits, 万 and 亿 between them, one 零 for a gap. Digits one by one beyond.
fn cardinal(text: &str) -> String {
    let Ok(number) = text.parse::<u64>() else { return one_by_one(text) };
    if number == 0 {
        return "零".to_owned();
    }
    let groups: Vec<u64> = (0..4).map(|i| number / 10_u64.pow(4 * i) % 10_000).collect();
    if number >= 10_u64.pow(16) {
        return one_by_one(text);
    }
    let mut said = String::new();
    let mut gap = false;
    for (place, group) in groups.iter().enumerate().rev() {
        if *group == 0 {
            gap = !said.is_empty();
            // 亿 stands for a whole group: 万亿 needs it even where its own group is empty.
            if place == 2 && !said.is_empty() {
                said.push('亿');
            }
            continue;
        }
        if !said.is_empty() && (gap || *group < 1000) {
            said.push('零');
        }
        gap = false;
        let first = said.is_empty();
        if first && *group == 2 && place > 0 {
            said.push('两');
        } else {
            said += &thousands(*group, first);
        }
        said += ["", "万", "亿", "万"][place];
    }
    said
}

/// A group of four digits. At the start of a number ten is 十 without 一, and two thousand 两千.
fn thousands(group: u64, first: bool) -> String {
    let mut said = String::new();
    let mut gap = false;
    for (place, unit) in [(1000, "千"), (100, "百"), (10, "十"), (1, "")] {
        let digit = group / place % 10;
        if digit == 0 {
            gap = !said.is_empty();
            continue;
        }
        if std::mem::take(&mut gap) {
            said.push('零');
        }
        let start = first && said.is_empty();
        match (digit, place) {
            (1, 10) if start => {}
            (2, 1000) if start => said.push('两'),
            _ => said.extend(DIGITS.get(digit as usize)),
        }
        said += unit;
    }
    said
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(text: &str, before: Option<char>, after: &str) -> String {
        read(&Number::of(text, after.chars().next()), before)
    }

    #[test]
    fn whole_numbers_are_read_with_their_units_and_zeros() {
        for (text, want) in [
            ("0", "零"),
            ("10", "十"),
            ("15", "十五"),
            ("100", "一百"),
            ("105", "一百零五"),
            ("110", "一百一十"),
            ("1010", "一千零一十"),
            ("2000", "两千"),
            ("10086", "一万零八十六"),
            ("20000", "两万"),
            ("100000", "十万"),
            ("120050", "十二万零五十"),
            ("100000000", "一亿"),
            ("1,234,567", "一百二十三万四千五百六十七"),
            ("1000000000000", "一万亿"),
        ] {
            assert_eq!(said(text, None, ""), want, "{text}");
        }
    }

    #[test]
    fn dates_times_money_shares_and_rows_of_digits() {
        for (text, after, want) in [
            ("2024", "年", "二零二四"),
            ("3.14", "", "三点一四"),
            ("50%", "", "百分之五十"),
            ("3:30", "", "三点三十分"),
            ("2:05", "", "两点零五分"),
            ("15:00", "", "十五点"),
            ("2024-11-22", "", "二零二四年十一月二十二日"),
            ("2024/1/2", "", "二零二四年一月二日"),
            ("11/22", "", "十一月二十二日"),
            ("1/2", "", "二分之一"),
            ("¥12.5", "", "十二点五元"),
            ("$3", "", "三美元"),
            ("3", "元", "三"),
            ("2", "个", "两"),
            ("2", "月", "二"),
            ("13800138000", "", "一三八零零一三八零零零"),
            ("010-12345678", "", "零一零一二三四五六七八"),
            ("5-10", "", "五到十"),
            ("3:2", "", "三比二"),
            ("25°C", "", "二十五摄氏度"),
            ("-5°C", "", "负五摄氏度"),
        ] {
            assert_eq!(said(text, None, after), want, "{text}{after}");
        }
        assert_eq!(said("2", Some('第'), "个"), "二");
    }
}
