//! The drawn lines of a figure.

use lianpu::drawing::Item;
use lianpu::figure::LineFigure;
use lianpu::geometry::Ribbon;
use lianpu::pose::Pose;

/// The lines of a pose by the order in which they are drawn, each by its name.
pub fn lines(figure: &LineFigure, pose: &Pose) -> Vec<(String, Vec<Ribbon>)> {
    fn collect(items: &[Item], lines: &mut Vec<(String, Vec<Ribbon>)>) {
        for item in items {
            match item {
                Item::Ink(ink) => lines.push((ink.name.clone(), ink.strokes.clone())),
                Item::Group(group) => collect(&group.items, lines),
                Item::Shared(shared) => collect(shared.items(), lines),
                _ => {}
            }
        }
    }
    let mut all = Vec::new();
    figure.draw(pose).layers.iter().for_each(|layer| collect(&layer.items, &mut all));
    all
}
