//! `--report`: one page of HTML that needs nothing else, no network and, but for the slider and the zoom, no script.
//!
//! Markup is made by a template that escapes whatever is put into it, so that nothing in a scene can become markup.

mod chart;
mod errors;
mod requires;
mod tradeoff;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD as BASE64;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::compare::Class;
use crate::exit::{Exit, Failure};
use crate::load::Loaded;
use crate::maps;
use crate::picture::Picture;
use crate::png;
use crate::report::Report;
use crate::sweep::Sweep;
use errors::Errors;

/// A scene's part of the page.
#[derive(Debug, Clone)]
pub struct Section(Markup);

/// The page: a part for every scene, in order, or why there is none.
pub fn page(command: &str, sections: &[Result<&Section, &Failure>]) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { "fixel: fixed point against float64" }
                style { (PreEscaped(include_str!("page.css"))) }
            }
            body {
                h1 { "Fixed point against float64" }
                @for section in sections {
                    @match section {
                        Ok(Section(section)) => (section),
                        Err(failure) => section { p.verdict.differs { (failure.message) } },
                    }
                }
                h2 { "Made by" }
                pre.command { (command) }
                script { (PreEscaped(include_str!("page.js"))) }
            }
        }
    };
    page.into_string()
}

/// The part of one scene, of the core's picture and the reference's; and what speed costs in accuracy, if that was asked for,
/// or why that is not known.
///
/// # Errors
/// A picture that cannot be made into a PNG.
pub fn section(
    loaded: &Loaded,
    [fixed, reference]: [&Picture; 2],
    report: &Report,
    sweep: Option<&Result<Sweep, String>>,
) -> Result<Section, Failure> {
    let (width, height) = fixed.size();
    let found = &report.comparison;
    let errors = Errors::new(fixed, reference, &found.classes);
    let difference = maps::classes(width, height, &found.classes);
    Ok(Section(html! {
        section.scene {
            h2 { (report.scene) }
            p.verdict.differs[report.exit() != Exit::Within] { (report.line()) }
            div.panes data-width=(width) {
                (pane("core", "Fixed point (fixel)", fixed)?)
                (pane("reference", "float64 reference", reference)?)
                (pane("difference", "Why they differ", &difference)?)
            }
            (legend(&errors))
            div.charts {
                (chart::histogram(&errors))
                (chart::cumulative(&errors))
            }
            @match sweep {
                Some(Ok(sweep)) => (tradeoff::tradeoff(sweep)),
                Some(Err(why)) => p { "No tiers to compare: " (why) "." },
                None => {}
            }
            (requires::features(loaded))
            (requires::table(loaded, width, height))
            details open[loaded.text.len() < 4000] {
                summary { "Scene text" }
                pre { (String::from_utf8_lossy(&loaded.text)) }
            }
        }
    }))
}

fn pane(kind: &str, title: &str, picture: &Picture) -> Result<Markup, Failure> {
    let bytes = png::encode(picture).map_err(|error| Failure {
        exit: Exit::Internal,
        message: format!("{title}: cannot be made into a PNG: {error}"),
        place: None,
    })?;
    let (width, height) = picture.size();
    Ok(html! {
        figure class=(kind) {
            figcaption { (title) }
            div.view {
                img src={ "data:image/png;base64," (BASE64.encode(bytes)) } width=(width) height=(height) alt=(title);
            }
        }
    })
}

/// What the colours of the difference picture mean, and how many pixels have each.
fn legend(errors: &Errors) -> Markup {
    html! {
        table.legend {
            caption { "Classes of pixels: the first that fits" }
            thead { tr { th { "class" } th { "pixels" } th { "share" } th { "largest error" } th { "what it means" } } }
            tbody {
                @for (class, name, meaning) in CLASSES {
                    @let of_class = errors.of(class);
                    tr.none[of_class.pixels == 0] {
                        td { span.swatch style={ "background:" (css_color(class)) } {} " " (name) }
                        td.number { (of_class.pixels) }
                        td.number { (format!("{:.3} %", errors.percent(of_class.pixels))) }
                        td.number { (of_class.largest) }
                        td { (meaning) }
                    }
                }
            }
        }
    }
}

/// In the order in which they are tried.
const CLASSES: [(Class, &str, &str); 8] = [
    (Class::Equal, "equal", "the same bytes"),
    (
        Class::Colour,
        "colour",
        "within the stated arithmetic bound and what snapping the corners changes there",
    ),
    (
        Class::Edge,
        "edge",
        "the sample lies so near an edge that snapping moves it to the other side",
    ),
    (
        Class::Depth,
        "depth",
        "two surfaces are within one depth step of each other",
    ),
    (
        Class::Texel,
        "texel",
        "the texture coordinate lies next to the border of a texel",
    ),
    (Class::Pole, "pole", "1/w is 0 within its bound"),
    (
        Class::Steep,
        "steep",
        "a power or a light's edge turns the stated error into what is seen",
    ),
    (Class::Unexplained, "unexplained", "a bug"),
];

fn css_color(class: Class) -> String {
    let [red, green, blue, _] = maps::class_color(class);
    format!("#{red:02x}{green:02x}{blue:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_of_a_message_becomes_markup() {
        let failure = Failure::bad("</p><script>alert(1)</script>&amp;\"'");
        let page = page("host-render '<b>.txt'", &[Err(&failure)]);
        assert!(page.contains("&lt;/p&gt;&lt;script&gt;alert(1)&lt;/script&gt;&amp;amp;&quot;"));
        assert!(page.contains("host-render '&lt;b&gt;.txt'"));
        assert!(!page.contains("alert(1)</script>"));
    }

    #[test]
    fn every_class_is_in_the_legend_in_its_colour() {
        let colors: std::collections::HashSet<_> = CLASSES.map(|(class, ..)| css_color(class)).into();
        assert_eq!(colors.len(), CLASSES.len());
        assert_eq!(css_color(Class::Unexplained), "#ff0000");
    }
}
