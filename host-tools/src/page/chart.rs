//! Charts as SVG: how many pixels differ by how much, and what share differs by no more than that.

use std::fmt::Write as _;

use maud::{Markup, html};

use super::errors::Errors;
use super::{CLASSES, css_color};
use crate::compare::Class;

/// Of the drawing, in its own units.
const WIDTH: f64 = 480.0;
const HEIGHT: f64 = 220.0;
/// Room for the labels.
const LEFT: f64 = 56.0;
const RIGHT: f64 = 12.0;
const TOP: f64 = 12.0;
const BOTTOM: f64 = 40.0;

/// Errors in levels that share a bar: each twice as wide as the one before, but for the first few.
const BARS: [(u8, u8); 11] = [
    (0, 0),
    (1, 1),
    (2, 2),
    (3, 3),
    (4, 4),
    (5, 8),
    (9, 16),
    (17, 32),
    (33, 64),
    (65, 128),
    (129, 255),
];

/// Pixels by error, on a logarithmic scale, each bar divided by class.
pub fn histogram(errors: &Errors) -> Markup {
    let decades = (errors.pixels().max(10) as f64).log10().ceil();
    let y = |count: u64| {
        // One pixel is already to be seen: a tenth of the first decade.
        let level = if count == 0 { 0.0 } else { 0.1 + (count as f64).log10() };
        HEIGHT - BOTTOM - level / (decades + 0.1) * (HEIGHT - TOP - BOTTOM)
    };
    let step = (WIDTH - LEFT - RIGHT) / BARS.len() as f64;
    html! {
        figure.chart {
            figcaption { "Pixels by error (levels of 255), logarithmic" }
            svg viewBox={ "0 0 " (WIDTH) " " (HEIGHT) } role="img" aria-label="Histogram of errors" {
                @for decade in 0..=decades as u32 {
                    @let count = 10u64.pow(decade);
                    line.grid x1=(LEFT) x2=(WIDTH - RIGHT) y1=(y(count)) y2=(y(count)) {}
                    text x=(LEFT - 6.0) y=(y(count) + 4.0) text-anchor="end" { (count) }
                }
                @for (i, &(least, most)) in BARS.iter().enumerate() {
                    @let x = LEFT + i as f64 * step;
                    @let total = CLASSES.map(|(class, ..)| errors.count(class, least..=most)).iter().sum::<u64>();
                    @for (class, from, to) in shares(errors, least, most) {
                        @let (high, low) = (y(total), y(0));
                        @let (top, bottom) = (low + (high - low) * to, low + (high - low) * from);
                        rect x=(x + 2.0) width=(step - 4.0) y=(top) height=(bottom - top) fill=(bar_color(class)) {}
                    }
                    text x=(x + step / 2.0) y=(HEIGHT - BOTTOM + 16.0) text-anchor="middle" {
                        @if least == most { (least) } @else { "≤ " (most) }
                    }
                    @if total > 0 {
                        text.value x=(x + step / 2.0) y=(y(total) - 3.0) text-anchor="middle" { (total) }
                    }
                }
                text x=(LEFT + (WIDTH - LEFT - RIGHT) / 2.0) y=(HEIGHT - 4.0) text-anchor="middle" { "error" }
            }
        }
    }
}

/// What part of a bar each class is, from the bottom.
fn shares(errors: &Errors, least: u8, most: u8) -> Vec<(Class, f64, f64)> {
    let counts = CLASSES.map(|(class, ..)| (class, errors.count(class, least..=most)));
    let total = counts.iter().map(|(_, count)| count).sum::<u64>().max(1) as f64;
    let mut below = 0;
    let mut shares = Vec::new();
    for (class, count) in counts {
        if count > 0 {
            shares.push((class, below as f64 / total, (below + count) as f64 / total));
        }
        below += count;
    }
    shares
}

/// As in the difference picture; what is black there would not be seen on a dark page.
fn bar_color(class: Class) -> String {
    if class == Class::Equal {
        "var(--quiet)".to_owned()
    } else {
        css_color(class)
    }
}

/// The share of pixels whose error is at most so large.
pub fn cumulative(errors: &Errors) -> Markup {
    let lowest = errors.percent(errors.at_most(0)).min(99.9);
    let x = |error: u8| LEFT + (f64::from(error) + 1.0).log2() / 8.0 * (WIDTH - LEFT - RIGHT);
    let y = |percent: f64| {
        let level = (percent - lowest) / (100.0 - lowest);
        HEIGHT - BOTTOM - level.clamp(0.0, 1.0) * (HEIGHT - TOP - BOTTOM)
    };
    let mut path = format!("M{:.2} {:.2}", x(0), y(errors.percent(errors.at_most(0))));
    for error in 1..=u8::MAX {
        // Writing into a string cannot fail. The share jumps at each error.
        let _ = write!(path, "H{:.2}V{:.2}", x(error), y(errors.percent(errors.at_most(error))));
    }
    html! {
        figure.chart {
            figcaption { "Share of pixels with at most this error; the largest is " (errors.largest()) }
            svg viewBox={ "0 0 " (WIDTH) " " (HEIGHT) } role="img" aria-label="Cumulative curve of errors" {
                @for quarter in 0..=4 {
                    @let percent = lowest + (100.0 - lowest) * f64::from(quarter) / 4.0;
                    line.grid x1=(LEFT) x2=(WIDTH - RIGHT) y1=(y(percent)) y2=(y(percent)) {}
                    text x=(LEFT - 6.0) y=(y(percent) + 4.0) text-anchor="end" { (format!("{percent:.2}")) "%" }
                }
                @for error in [0u8, 1, 2, 5, 15, 50, 127, 255] {
                    text x=(x(error)) y=(HEIGHT - BOTTOM + 16.0) text-anchor="middle" { (error) }
                }
                path.curve d=(path) {}
                text x=(LEFT + (WIDTH - LEFT - RIGHT) / 2.0) y=(HEIGHT - 4.0) text-anchor="middle" { "error" }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Picture;

    #[test]
    fn bars_hold_every_error_once() {
        let mut next = 0u32;
        for (least, most) in BARS {
            assert_eq!(u32::from(least), next);
            next = u32::from(most) + 1;
        }
        assert_eq!(next, 256);
    }

    #[test]
    fn a_bar_is_divided_by_class() {
        let grey = |v: u8| Picture::new(4, 1, vec![[v, v, v, 255]; 4]);
        let classes = [Class::Colour, Class::Edge, Class::Edge, Class::Edge];
        let errors = Errors::new(&grey(7), &grey(6), &classes);
        let parts = shares(&errors, 1, 1);
        assert_eq!(parts, [(Class::Colour, 0.0, 0.25), (Class::Edge, 0.25, 1.0)]);
        assert_eq!(shares(&errors, 2, 2), []);
        let svg = histogram(&errors).into_string();
        assert_eq!(svg.matches("<rect").count(), 2);
    }
}
