//! Paints portraits of people who do not exist, so that no real likeness lies in the repository.
//!
//! A head is a distance function (a skull through average proportions, with nose, lips, lids and ears blended on), its
//! hair is grown hair by hair, and both are lit and photographed: passport light, a grey wall, grain. The same bytes
//! come out on every run.
//!
//! ```sh
//! cargo run --release --features tools --example portrait -- neutral projects/nihao/faces/teacher/neutral.png
//! cargo run --release --features tools --example portrait -- turned tests/pictures/refused/turned.png --size 320
//! cargo run --release --features tools --example portrait -- away tests/pictures/refused/away.png --size 320
//! cargo run --release --features tools --example portrait -- profile tests/pictures/refused/profile.png --size 320
//! cargo run --release --features tools --example portrait -- two tests/pictures/refused/two.png --size 320
//! cargo run --release --features tools --example portrait -- man tests/pictures/man.png --size 480
//! ```
//!
//! Further pictures, for trying things out: `tilted`, `sidelight`, `small`, `open`.

#![allow(dead_code, reason = "the frames of xiyang use parts of what paints that this does not")]

use std::error::Error;
use std::path::PathBuf;

#[path = "portrait/act.rs"]
mod act;
#[path = "portrait/body.rs"]
mod body;
#[path = "portrait/curve.rs"]
mod curve;
#[path = "portrait/eye.rs"]
mod eye;
#[path = "portrait/figure.rs"]
mod figure;
#[path = "portrait/film.rs"]
mod film;
#[path = "portrait/flesh.rs"]
mod flesh;
#[path = "portrait/hair.rs"]
mod hair;
#[path = "portrait/head.rs"]
mod head;
#[path = "portrait/mass.rs"]
mod mass;
#[path = "portrait/noise.rs"]
mod noise;
#[path = "portrait/person.rs"]
mod person;
#[path = "portrait/skin.rs"]
mod skin;
#[path = "portrait/skull.rs"]
mod skull;
#[path = "portrait/strand.rs"]
mod strand;
#[path = "portrait/vector.rs"]
mod vector;
#[path = "portrait/view.rs"]
mod view;

use person::Person;
use view::{Canvas, Rig, Stand};

/// How the passport frame shows a face: pupils at y 278, 95 pixels apart.
const PASSPORT: Stand = Stand { x: 300.0, y: 278.0, scale: 1.0, yaw: 0.0, roll: 0.0 };

/// The figures of a picture and their light.
fn scene(name: &str) -> Option<(Vec<(Person, Stand)>, Rig)> {
    let woman = Person::woman();
    let degrees = |d: f32| d.to_radians();
    let one = |person: Person, stand: Stand| (vec![(person, stand)], Rig::soft());
    Some(match name {
        "neutral" => one(woman, PASSPORT),
        "turned" => one(woman, Stand { x: 250.0, yaw: degrees(60.0), ..PASSPORT }),
        "away" => one(woman, Stand { yaw: degrees(180.0), ..PASSPORT }),
        "profile" => one(woman, Stand { x: 260.0, yaw: degrees(90.0), ..PASSPORT }),
        "tilted" => one(woman, Stand { roll: degrees(18.0), ..PASSPORT }),
        "small" => one(woman, Stand { x: 318.0, y: 505.0, scale: 18.0 / 95.0, ..PASSPORT }),
        "open" => one(Person { open: 1.0, ..woman }, PASSPORT),
        "man" => one(Person::man(), PASSPORT),
        "sidelight" => (vec![(woman, PASSPORT)], Rig::side()),
        "two" => {
            let left = Stand { x: 158.0, y: 312.0, scale: 0.50, ..PASSPORT };
            let right = Stand { x: 446.0, y: 276.0, scale: 0.51, ..PASSPORT };
            (vec![(woman, left), (Person::man(), right)], Rig::soft())
        }
        _ => return None,
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    let usage = "portrait NAME OUT.png [--size PIXELS]; NAME: neutral, turned, away, profile, two, tilted, sidelight, \
                 small, open, man";
    let words: Vec<String> = std::env::args().skip(1).collect();
    let (name, out, size) = match words.as_slice() {
        [name, out] => (name, out, 600),
        [name, out, flag, size] if flag == "--size" => (name, out, size.parse()?),
        _ => return Err(usage.into()),
    };
    let (figures, rig) = scene(name).ok_or(usage)?;
    let mut canvas = Canvas::wall(size, &rig);
    for (person, stand) in figures {
        let head = head::Head::new(person);
        let strands = hair::grow(&head);
        let mass = mass::Mass::of(&strands, &head.skull);
        figure::Figure::new(&head, &mass, stand, rig).expose(&mut canvas);
        strand::expose(&strands, &mass, &stand, &rig, &mut canvas);
    }
    let pixels = film::develop(&canvas, 1);
    film::write(&PathBuf::from(out), size, &pixels)?;
    Ok(())
}
