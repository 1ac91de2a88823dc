//! Masks on the coarse grid of the frame, two units a cell: polygons, pieces, holes.
//!
//! Hair and background are told apart on this grid; outlines pass between its cells, so they are finer than it.

use super::frame::{Frame, HEIGHT, Lab, VIEW, WIDTH, scan};
use crate::drawing::Image;
use crate::geometry::Point;
use crate::photo::{Mask, Neighbours, Plane, Regions};

/// Units a cell.
pub(super) const CELL: f64 = 2.0;
/// Cells in a row.
pub(super) const COLUMNS: usize = WIDTH / 2;
/// Rows of cells.
pub(super) const ROWS: usize = HEIGHT / 2;
/// Cells.
pub(super) const CELLS: usize = COLUMNS * ROWS;

/// Where the middle of a cell is, in units.
pub(super) fn centre(cell: usize) -> Point {
    let (row, column) = (cell / COLUMNS, cell % COLUMNS);
    // A cell is the mean of frame pixels 2i and 2i + 1.
    Point::new(VIEW.x0 + column as f64 * CELL + 0.5, VIEW.y0 + row as f64 * CELL + 0.5)
}

/// The row of cells at a height in units.
pub(super) fn row_at(y: f64) -> usize {
    ((y - VIEW.y0 - 0.5) / CELL).round().clamp(0.0, (ROWS - 1) as f64) as usize
}

/// The column of cells at a place in units.
pub(super) fn column_at(x: f64) -> usize {
    ((x - VIEW.x0 - 0.5) / CELL).round().clamp(0.0, (COLUMNS - 1) as f64) as usize
}

/// The colours of the cells, and which of them the photo shows.
pub(super) fn cells(frame: &Frame) -> (Vec<Lab>, Vec<bool>) {
    let mut lab = Vec::with_capacity(CELLS);
    let mut inside = Vec::with_capacity(CELLS);
    for row in 0..ROWS {
        for column in 0..COLUMNS {
            let first = 2 * row * WIDTH + 2 * column;
            let four = [first, first + 1, first + WIDTH, first + WIDTH + 1];
            lab.push(std::array::from_fn(|k| four.iter().map(|i| frame.lab[*i][k]).sum::<f32>() / 4.0));
            inside.push(four.iter().all(|i| frame.inside[*i]));
        }
    }
    (lab, inside)
}

/// No cell.
pub(super) fn no_cells() -> Mask {
    Mask::filled(COLUMNS, ROWS, false)
}

/// The value of each cell, by its index.
pub(super) fn per_cell<T>(value: impl FnMut(usize) -> T) -> Image<T> {
    Image::new(COLUMNS, ROWS, (0..CELLS).map(value).collect())
}

/// The cells whose middles lie inside a polygon given in units.
pub(super) fn cells_in(polygon: &[Point]) -> Mask {
    let mut mask = no_cells();
    let cells: Vec<Point> =
        polygon.iter().map(|p| Point::new((p.x - VIEW.x0 - 0.5) / CELL, (p.y - VIEW.y0 - 0.5) / CELL)).collect();
    scan(&cells, COLUMNS, ROWS, |row, from, to| mask.row_mut(row)[from..to].fill(true));
    mask
}

/// The area of a mask in square units.
pub(super) fn area_of(mask: &Mask) -> f64 {
    mask.count() as f64 * CELL * CELL
}

/// 1 for every cell of a mask, 0 for others.
pub(super) fn field_of(mask: &Mask) -> Plane {
    mask.map(|v| f32::from(u8::from(*v)))
}

/// The connected pieces (sharing an edge) of a mask of more than 20 square units, largest first, at most 80.
pub(super) fn pieces_of(mask: &Mask) -> Vec<Mask> {
    let regions = Regions::of(mask, Neighbours::Four);
    let mut list = regions.list.clone();
    list.sort_by_key(|region| std::cmp::Reverse(region.area));
    let large = list.iter().take_while(|region| region.area > 5).take(80);
    large
        .map(|region| {
            let mut piece = no_cells();
            regions.pixels_of(region).for_each(|at| piece[at] = true);
            piece
        })
        .collect()
}

/// A mask with all holes smaller than `least` square units filled; what reaches the left, upper or right border is none.
pub(super) fn without_holes(mut mask: Mask, least: f64) -> Mask {
    for hole in pieces_of(&mask.not()) {
        let open = hole.indices().any(|c| c % COLUMNS == 0 || c % COLUMNS == COLUMNS - 1 || c / COLUMNS == 0);
        if !open && area_of(&hole) < least {
            mask = mask.or(&hole);
        }
    }
    mask
}
