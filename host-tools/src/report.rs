//! What a run says about a scene: a line for people, an object for programs.

use std::fmt::Write as _;
use std::path::Path;

use serde_json::{Value, json};

use crate::against::Agreement;
use crate::compare::{Comparison, Explained};
use crate::exit::{Exit, Failure};
use crate::fixed::dials::Tier;
use crate::scene::format::Format;
use crate::words::counted;

/// All that is known of a rendered scene.
#[derive(Debug)]
pub struct Report {
    /// The scene's file, as the user named it.
    pub scene: String,
    /// Its format.
    pub format: Format,
    /// The core's tier.
    pub quality: Tier,
    /// Width of the picture.
    pub width: u32,
    /// Height of the picture.
    pub height: u32,
    /// Where the two back ends differ and why.
    pub comparison: Comparison,
    /// Time to draw with the core.
    pub seconds_fixed: f64,
    /// Time to draw with the reference.
    pub seconds_reference: f64,
    /// With `--against`: how the core's picture and the reference's compare with the existing one.
    pub against: Option<[Agreement; 2]>,
    /// With `--ties`, so that some pixels may be excused.
    pub ties: bool,
}

impl Report {
    /// Whether the pictures are within their limits.
    pub fn exit(&self) -> Exit {
        let agrees = self
            .against
            .is_none_or(|[fixed, reference]| fixed.over_2_percent_outside_ties == 0 && reference.identical);
        if self.comparison.unexplained == 0 && agrees {
            Exit::Within
        } else {
            Exit::Differs
        }
    }

    /// One line for people.
    pub fn line(&self) -> String {
        let found = &self.comparison;
        let mut line = format!("{}: {}x{}", self.scene, self.width, self.height);
        if self.quality != Tier::Exact {
            push(&mut line, format_args!(", quality {}", self.quality));
        }
        push(
            &mut line,
            format_args!(
                ", {} drawn, {} unexplained",
                counted(found.pixels_drawn, "pixel"),
                found.unexplained
            ),
        );
        if self.quality != Tier::Exact {
            line.push_str(" by the bounds of exact");
        }
        let total: u64 = classes(&found.explained).iter().map(|(_, count)| count).sum();
        push(&mut line, format_args!(", {total} explained"));
        let mut opening = " (";
        for (name, count) in classes(&found.explained) {
            if count > 0 {
                let share = percent(count, found.most_drawn);
                push(&mut line, format_args!("{opening}{name} {count} = {share:.2} %"));
                opening = ", ";
            }
        }
        line.push_str(if total > 0 { ")" } else { "" });
        push(&mut line, format_args!(", largest error {}", found.max_channel_error));
        match found.psnr {
            Some(psnr) => push(&mut line, format_args!(", PSNR {psnr:.1} dB")),
            None => line.push_str(", pictures equal"),
        }
        if let Some([fixed, reference]) = self.against {
            let (outside, all) = (fixed.over_2_percent_outside_ties, fixed.over_2_percent);
            if self.ties {
                push(
                    &mut line,
                    format_args!(", against: {outside} over 2 % outside ties, {all} in all"),
                );
            } else {
                push(&mut line, format_args!(", against: {all} over 2 %"));
            }
            line.push_str(", reference ");
            line.push_str(if reference.identical {
                "identical"
            } else {
                "NOT identical"
            });
        }
        push(
            &mut line,
            format_args!(
                ", {:.1} ms fixed, {:.1} ms reference",
                self.seconds_fixed * 1e3,
                self.seconds_reference * 1e3
            ),
        );
        line
    }

    /// One object for programs; its keys stay.
    pub fn json(&self) -> Value {
        let found = &self.comparison;
        let explained: serde_json::Map<_, _> = classes(&found.explained)
            .into_iter()
            .map(|(name, count)| (name.to_owned(), Value::from(count)))
            .collect();
        let mut object = json!({
            "scene": self.scene,
            "format": self.format.to_string(),
            "quality": self.quality.to_string(),
            "width": self.width,
            "height": self.height,
            "pixels_drawn": found.pixels_drawn,
            "coverage_differs": found.coverage_differs,
            "unexplained": found.unexplained,
            "max_channel_error": found.max_channel_error,
            "rmse": found.rmse,
            "psnr": found.psnr,
            "seconds_fixed": self.seconds_fixed,
            "seconds_reference": self.seconds_reference,
            "explained": explained,
        });
        if let Some([fixed, reference]) = self.against {
            object["against_fixed"] = agreement(fixed);
            object["against_reference"] = agreement(reference);
        }
        object
    }
}

/// The object of a scene that was not rendered: what was printed, and where in the scene if it was the scene's fault.
pub fn failure(scene: &Path, failure: &Failure) -> Value {
    json!({
        "scene": scene.display().to_string(),
        "error": failure.message,
        "exit": failure.exit as u8,
        "line": failure.place.map(|place| place.line),
        "column": failure.place.map(|place| place.column),
    })
}

fn agreement(agreement: Agreement) -> Value {
    json!({
        "over_2_percent": agreement.over_2_percent,
        "over_2_percent_outside_ties": agreement.over_2_percent_outside_ties,
        "max_channel_error": agreement.max_channel_error,
        "identical": agreement.identical,
    })
}

fn classes(explained: &Explained) -> [(&'static str, u64); 6] {
    [
        ("colour", explained.colour),
        ("edge", explained.edge),
        ("depth", explained.depth),
        ("texel", explained.texel),
        ("pole", explained.pole),
        ("steep", explained.steep),
    ]
}

fn percent(part: u64, whole: u64) -> f64 {
    100.0 * part as f64 / whole.max(1) as f64
}

fn push(line: &mut String, text: std::fmt::Arguments<'_>) {
    // Writing into a string cannot fail.
    let _ = line.write_fmt(text);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Fault, Place};

    fn report(unexplained: u64, psnr: Option<f64>) -> Report {
        let explained = Explained {
            colour: 2,
            edge: 3,
            depth: 0,
            texel: 0,
            pole: 0,
            steep: 0,
        };
        Report {
            scene: "a.txt".to_owned(),
            format: Format::Hw2,
            quality: Tier::Exact,
            width: 20,
            height: 10,
            comparison: Comparison {
                beyond_gradient: 0,
                pixels_drawn: 100,
                most_drawn: 100,
                coverage_differs: 1,
                unexplained,
                max_channel_error: 7,
                rmse: 0.5,
                psnr,
                explained,
                classes: Vec::new(),
            },
            seconds_fixed: 0.0015,
            seconds_reference: 0.25,
            against: None,
            ties: false,
        }
    }

    #[test]
    fn the_line() {
        let mut report = report(0, Some(54.25));
        assert_eq!(
            report.line(),
            "a.txt: 20x10, 100 pixels drawn, 0 unexplained, 5 explained (colour 2 = 2.00 %, edge 3 = 3.00 %), \
             largest error 7, PSNR 54.2 dB, 1.5 ms fixed, 250.0 ms reference"
        );
        (report.comparison.pixels_drawn, report.comparison.most_drawn) = (1, 200);
        assert!(
            report
                .line()
                .contains("1 pixel drawn, 0 unexplained, 5 explained (colour 2 = 1.00 %, edge 3 = 1.50 %)")
        );
        (report.comparison.pixels_drawn, report.comparison.most_drawn) = (100, 100);
        report.quality = Tier::Fast;
        assert!(report.line().starts_with(
            "a.txt: 20x10, quality fast, 100 pixels drawn, 0 unexplained by the bounds of exact, 5 explained"
        ));
        report.against = Some([Agreement::default(); 2]);
        assert!(report.line().contains(", against: 0 over 2 %, reference NOT identical"));
        report.ties = true;
        assert!(
            report
                .line()
                .contains(", against: 0 over 2 % outside ties, 0 in all, reference NOT identical")
        );
        report.comparison.pixels_drawn = 1;
        assert!(report.line().contains(", 1 pixel drawn, "));
    }

    #[test]
    fn equal_pictures_have_no_psnr() {
        assert!(report(0, None).json()["psnr"].is_null());
        assert_eq!(report(0, Some(54.25)).json()["psnr"], 54.25);
        assert!(report(0, None).line().contains("pictures equal"));
    }

    #[test]
    fn what_makes_a_scene_differ() {
        let exact = Agreement {
            identical: true,
            ..Agreement::default()
        };
        let excused = Agreement {
            over_2_percent: 9,
            ..Agreement::default()
        };
        let stray = Agreement {
            over_2_percent: 9,
            over_2_percent_outside_ties: 1,
            ..Agreement::default()
        };
        for (unexplained, against, exit) in [
            (0, None, Exit::Within),
            (1, None, Exit::Differs),
            (0, Some([excused, exact]), Exit::Within),
            (0, Some([stray, exact]), Exit::Differs),
            (0, Some([exact, excused]), Exit::Differs),
            (1, Some([exact, exact]), Exit::Differs),
        ] {
            let report = Report {
                against,
                ..report(unexplained, None)
            };
            assert_eq!(report.exit(), exit, "{unexplained} unexplained, {against:?}");
        }
    }

    #[test]
    fn a_failed_scene_has_an_object_too() {
        let fault = Fault::new(Place { line: 3, column: 4 }, "no");
        let file = Path::new("a.txt");
        let object = failure(file, &Failure::scene(file, &fault));
        assert_eq!(object["error"], "a.txt: line 3, column 4: no");
        assert_eq!(
            (&object["line"], &object["column"], &object["exit"]),
            (&3.into(), &4.into(), &2.into())
        );
        assert!(failure(file, &Failure::bad("no"))["line"].is_null());
    }
}
