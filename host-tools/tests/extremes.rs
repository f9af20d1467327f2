//! Bounds at the limits of the numbers: they hold as far as is promised, and the page says what happens beyond.

use std::path::Path;

use fixel_host::extremes::{Outcome, curves, table};

/// Set to write the page and its charts instead of comparing them.
const UPDATE: &str = "FIXEL_UPDATE_DOCS";

#[test]
fn bounds_hold_as_far_as_promised_and_the_page_says_so() {
    let curves = curves();
    for curve in &curves {
        for (value, outcome) in &curve.outcomes {
            println!("{} {value:e}: {outcome:?}", curve.family.name);
        }
    }
    for curve in &curves {
        assert!(curve.keeps_its_promise(), "{}: {}", curve.family.name, curve.beyond());
        let refused = curve
            .outcomes
            .iter()
            .any(|(_, outcome)| matches!(outcome, Outcome::Refused(_)));
        assert!(refused || curve.holds_to() == curve.outcomes.last().map(|(value, _)| *value));
    }
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    let page = docs.join("extremes.md");
    let text = std::fs::read_to_string(&page).expect("docs/extremes.md");
    let (before, rest) = text.split_once("<!-- table -->\n").expect("where the table begins");
    let (_, after) = rest.split_once("<!-- end of table -->").expect("where it ends");
    let expected = format!("{before}<!-- table -->\n{}<!-- end of table -->{after}", table(&curves));
    let mut files = vec![(page, expected)];
    for curve in &curves {
        files.push((docs.join(format!("extremes/{}.svg", curve.family.name)), curve.chart()));
    }
    for (file, content) in files {
        if std::env::var_os(UPDATE).is_some() {
            std::fs::write(&file, content).expect("written");
        } else {
            let found = std::fs::read_to_string(&file).unwrap_or_default();
            assert!(
                found == content,
                "{} is stale: run this test with {UPDATE}=1",
                file.display()
            );
        }
    }
}
