//! `--report` in a real browser: headless Chromium, named by `FIXEL_BROWSER`.

mod program;

use std::io::Cursor;
use std::process::Command;

use fixel_host::png;
use program::Folder;
use serde_json::Value;

/// A scene whose text, name and command line try to become markup.
const SCENE: &str = "png 6 5 out.png\n# </pre><script>document.title = \"taken\"</script>\nxyz -1 -1 0\nxyz -1 1 0\n\
                     xyz 1 -1 0\ncolor 1 .5 .25\ntrif 1 2 3\n";

const NAME: &str = "<img+src=x+onerror=alert(1)>.txt";

/// Goes before everything: what goes wrong from the first byte on is kept.
const WATCH: &str = "<script>const faults = []; addEventListener('error', (e) => faults.push(e.message));</script>";

/// Moves the controls as a reader would, and leaves what it sees in an element of its own.
const READER: &str = r#"<pre id="findings"></pre><script>
addEventListener("load", async () => {
  const bytes = async (image) => {
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: image.naturalWidth, height: image.naturalHeight });
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    return [...context.getImageData(0, 0, canvas.width, canvas.height).data].join(" ");
  };
  const move = (name, value) => {
    const input = document.querySelector(`input[name=${name}]`);
    input.value = value;
    input.dispatchEvent(new Event("input"));
  };
  const upper = document.querySelector(".stage img + img");
  const found = { faults, title: document.title, pictures: [], cuts: [], widths: [] };
  for (const image of document.querySelectorAll(".panes img")) found.pictures.push(await bytes(image));
  for (const cut of [0, 25, 100]) {
    move("cut", cut);
    found.cuts.push(getComputedStyle(upper).clipPath);
  }
  for (const zoom of [0, 3]) {
    move("zoom", zoom);
    found.widths.push([...document.querySelectorAll(".panes img, .stage img")].map((i) => i.getBoundingClientRect().width));
  }
  const style = getComputedStyle(document.body);
  found.colors = [style.color, style.backgroundColor];
  found.requests = performance.getEntriesByType("resource").map((e) => e.name).filter((n) => !n.startsWith("data:"));
  document.getElementById("findings").textContent = JSON.stringify(found);
});
</script>"#;

/// The page in a frame as wide as a phone.
fn on_a_phone(page: &str) -> String {
    let quoted = page.replace('&', "&amp;").replace('"', "&quot;");
    format!(
        "<!DOCTYPE html><iframe width=360 height=700 srcdoc=\"{quoted}\"></iframe><pre id=findings></pre><script>
        addEventListener('load', () => {{
          const root = document.querySelector('iframe').contentDocument.documentElement;
          const columns = getComputedStyle(root.querySelector('.panes')).gridTemplateColumns.split(' ').length;
          const size = parseFloat(getComputedStyle(root.querySelector('pre')).fontSize);
          const found = {{ inner: root.clientWidth, content: root.scrollWidth, columns, size }};
          document.getElementById('findings').textContent = JSON.stringify(found);
        }});
        </script>"
    )
}

/// The browser to test in; says so where there is none to be had.
fn browser() -> Option<String> {
    let browser = std::env::var("FIXEL_BROWSER").ok();
    if browser.is_none() {
        println!("SKIPPED: FIXEL_BROWSER is not set, so that no report was looked at in a browser");
    }
    browser
}

/// How often a page is opened until it says something: a browser may print it before its scripts have ended, where other work
/// takes the machine's time from it. What a page says is never asked for twice.
const VISITS: usize = 8;

/// What the page says it found, once the browser has run it, without a word on the console.
fn visit(browser: &str, folder: &Folder, page: &str, options: &[&str]) -> Value {
    folder.write("visited.html", page);
    let said = (0..VISITS).find_map(|_| {
        let dom = opened(browser, folder, options);
        let findings = dom
            .split("id=\"findings\">")
            .nth(1)
            .and_then(|rest| rest.split("</pre>").next())
            .unwrap_or_else(|| panic!("no findings in {dom}"));
        (!findings.is_empty()).then(|| findings.replace("&amp;", "&").replace("&gt;", ">").replace("&lt;", "<"))
    });
    let said = said.unwrap_or_else(|| panic!("opened {VISITS} times, and nothing was found"));
    serde_json::from_str(&said).unwrap_or_else(|error| panic!("{error}: {said}"))
}

/// The page as the browser has it in the end.
fn opened(browser: &str, folder: &Folder, options: &[&str]) -> String {
    let output = Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
            "--no-first-run",
        ])
        .args([
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
        ])
        .args(["--enable-logging=stderr", "--virtual-time-budget=10000", "--dump-dom"])
        .args(options)
        .arg(format!("--user-data-dir={}", folder.path("browser").display()))
        .arg(format!("file://{}", folder.path("visited.html").display()))
        .output()
        .expect("the browser starts");
    let log = String::from_utf8_lossy(&output.stderr);
    let console: Vec<_> = log.lines().filter(|line| line.contains(":CONSOLE")).collect();
    assert!(console.is_empty(), "{console:?}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The page for [`SCENE`], and the pictures that it should show, as their bytes in decimal.
fn report(folder: &Folder) -> (String, [String; 3]) {
    let run = folder.write(NAME, SCENE).run(&format!(
        "{NAME} --report r.html -o f.png --reference-out r.png --diff-out d.png"
    ));
    assert_eq!(run.code, Some(0), "{run:?}");
    let pictures = ["f.png", "r.png", "d.png"].map(|name| {
        let picture = png::decode(Cursor::new(folder.read(name))).expect("a PNG file");
        let bytes: Vec<String> = picture.pixels.iter().flatten().map(u8::to_string).collect();
        bytes.join(" ")
    });
    (String::from_utf8(folder.read("r.html")).expect("UTF-8"), pictures)
}

fn instrumented(page: &str) -> String {
    let page = page.replacen("<head>", &format!("<head>{WATCH}"), 1);
    page.replacen("</body>", &format!("{READER}</body>"), 1)
}

#[test]
fn the_page_is_right_in_a_browser() {
    let Some(browser) = browser() else { return };
    let folder = Folder::new();
    let (page, pictures) = report(&folder);
    let found = visit(&browser, &folder, &instrumented(&page), &[]);
    assert_eq!(found["faults"], serde_json::json!([]));
    assert_eq!(found["requests"], serde_json::json!([]), "no network");
    assert_eq!(found["title"], "fixel: fixed point against float64");
    assert_eq!(found["pictures"], serde_json::json!(pictures));
    assert_eq!(
        found["cuts"],
        serde_json::json!([
            "inset(0px 0px 0px 0%)",
            "inset(0px 0px 0px 25%)",
            "inset(0px 0px 0px 100%)"
        ])
    );
    let widths = |zoom: usize| -> Vec<f64> {
        let widths = found["widths"][zoom].as_array().expect("widths").iter();
        widths.map(|width| width.as_f64().expect("a number")).collect()
    };
    assert!(widths(0).iter().take(3).all(|&width| width == 6.0), "{:?}", widths(0));
    assert_eq!(widths(1), [48.0; 5]);
}

#[test]
fn a_page_that_is_wrong_is_seen_to_be() {
    let Some(browser) = browser() else { return };
    let folder = Folder::new();
    let (page, pictures) = report(&folder);
    let broken = page.replacen(".cloneNode()", ".copyNode()", 1);
    let found = std::panic::catch_unwind(|| visit(&browser, &folder, &instrumented(&broken), &[]));
    assert!(found.is_err(), "a script that fails");
    let first = page
        .split("base64,")
        .nth(1)
        .and_then(|rest| rest.split('"').next())
        .expect("a picture");
    let last = page
        .split("base64,")
        .nth(3)
        .and_then(|rest| rest.split('"').next())
        .expect("a picture");
    let found = visit(&browser, &folder, &instrumented(&page.replacen(first, last, 1)), &[]);
    assert_ne!(found["pictures"], serde_json::json!(pictures), "another picture");
}

#[test]
fn it_can_be_read_on_a_phone_and_in_the_dark() {
    let Some(browser) = browser() else { return };
    let folder = Folder::new();
    let (page, _) = report(&folder);
    let phone = visit(&browser, &folder, &on_a_phone(&page), &[]);
    assert_eq!(phone["content"], phone["inner"], "nothing sticks out sideways: {phone}");
    assert_eq!(phone["columns"], 1);
    assert!(phone["size"].as_f64().is_some_and(|size| size >= 13.0), "{phone}");

    for (scheme, option) in [
        ("dark", "--blink-settings=preferredColorScheme=0"),
        ("light", "--blink-settings=preferredColorScheme=1"),
    ] {
        let found = visit(&browser, &folder, &instrumented(&page), &[option]);
        let [ink, ground] = [0, 1].map(|i| luminance(found["colors"][i].as_str().expect("a colour")));
        let (lighter, darker) = (ink.max(ground), ink.min(ground));
        assert!(
            (lighter + 0.05) / (darker + 0.05) >= 7.0,
            "{scheme}: contrast of {}",
            found["colors"]
        );
        assert_eq!(ground < ink, scheme == "dark", "{}", found["colors"]);
    }
}

/// Relative luminance by WCAG 2 of `rgb(r, g, b)`.
fn luminance(color: &str) -> f64 {
    let channels = color.trim_start_matches("rgb(").trim_end_matches(')').split(", ");
    let linear = channels.map(|channel| {
        let v = channel.parse::<f64>().expect("a channel") / 255.0;
        if v <= 0.03928 {
            v / 12.92
        } else {
            ((v + 0.055) / 1.055).powf(2.4)
        }
    });
    linear.zip([0.2126, 0.7152, 0.0722]).map(|(v, weight)| v * weight).sum()
}

#[test]
fn the_page_needs_no_network_and_holds_the_scene_as_text() {
    let folder = Folder::new();
    let (page, _) = report(&folder);
    assert!(page.contains("# &lt;/pre&gt;&lt;script&gt;"));
    assert!(page.contains("&lt;img+src=x+onerror=alert(1)&gt;.txt"));
    for reference in ["http:", "https:", "//", "url(", "@import"] {
        let mut places = page.match_indices(reference).map(|(at, _)| at);
        let comment = |at: usize| reference == "//" && !page[..at].ends_with(':');
        assert!(places.all(comment), "{reference}");
    }
}

#[test]
fn the_report_overwrites_nothing_that_is_read_or_written() {
    let folder = Folder::new();
    folder.write("a.txt", SCENE);
    for (arguments, what) in [
        ("a.txt --report a.txt", "would overwrite a scene"),
        (
            "a.txt --report out.png",
            "its output ./out.png would overwrite the report",
        ),
    ] {
        let run = folder.run(arguments);
        assert_eq!(run.code, Some(2), "{run:?}");
        assert!(run.err.contains(what), "{}", run.err);
        assert_eq!(folder.names(), ["a.txt"]);
    }
}

#[test]
fn a_scene_that_fails_is_in_the_report_too() {
    let folder = Folder::new();
    let run = folder
        .write("a.txt", SCENE)
        .write("b.txt", "png 1 1 b.png\nxyz")
        .run("a.txt b.txt --report r.html");
    assert_eq!(run.code, Some(2), "{run:?}");
    let page = String::from_utf8(folder.read("r.html")).expect("UTF-8");
    assert_eq!(run.out.lines().count(), 1, "{}", run.out);
    assert!(page.contains("<h2>a.txt</h2>") && page.contains("b.txt: line 2, column"));
    let run = folder.run("a.txt --report none/r.html");
    assert_eq!(run.code, Some(3), "{run:?}");
}

/// Measures the chart of the sweep.
const CHART_READER: &str = r#"<pre id="findings"></pre><script>
addEventListener("load", () => {
  const svg = document.querySelector("figure.tradeoff svg");
  const boxes = [...svg.querySelectorAll("text, circle")].map((e) => e.getBBox());
  const names = [...svg.querySelectorAll("text.name")];
  const found = {
    faults,
    points: svg.querySelectorAll("circle").length,
    front: svg.querySelectorAll("circle.front").length,
    names: names.map((e) => e.textContent),
    sides: [Math.min(...boxes.map((b) => b.x)), Math.max(...boxes.map((b) => b.x + b.width))],
    heights: names.map((e) => e.getBBox().y),
    box: [svg.viewBox.baseVal.width, svg.viewBox.baseVal.height],
  };
  document.getElementById("findings").textContent = JSON.stringify(found);
});
</script>"#;

#[test]
fn the_chart_shows_what_the_sweep_found() {
    let folder = Folder::new();
    let run = folder
        .write(NAME, SCENE.replace("trif", "trig"))
        .run_alone(&format!("{NAME} --report r.html --sweep"));
    assert_eq!(run.code, Some(0), "{run:?}");
    let page = String::from_utf8(folder.read("r.html")).expect("UTF-8");
    assert!(page.contains("What firmware needs to draw it") && page.contains("<li>depth buffer: none"));
    let without = folder.run_alone(&format!("{NAME} --report r.html"));
    assert_eq!(without.code, Some(0), "{without:?}");
    assert!(!String::from_utf8_lossy(&folder.read("r.html")).contains("figure class=\"chart tradeoff\""));

    let names = [
        "exact",
        "balanced",
        "fast",
        "exact+perspective=32-bit",
        "exact+perspective=spans",
        "exact+perspective=affine",
        "exact+depth=off",
        "exact+output=565",
        "exact+output=565-dither",
        "exact+output=1-bit",
    ];
    for name in names {
        assert!(page.contains(&format!(">{name}</text>")), "{name}");
    }
    let Some(browser) = browser() else { return };
    let watched = page.replacen("<head>", &format!("<head>{WATCH}"), 1);
    let watched = watched.replacen("</body>", &format!("{CHART_READER}</body>"), 1);
    let found = visit(&browser, &folder, &watched, &[]);
    assert_eq!(found["faults"], serde_json::json!([]));
    assert_eq!(found["points"], names.len());
    assert!(found["front"].as_u64().is_some_and(|front| front >= 1), "{found}");
    let numbers = |key: &str| -> Vec<f64> {
        let numbers = found[key].as_array().expect("numbers").iter();
        numbers.map(|number| number.as_f64().expect("a number")).collect()
    };
    let (sides, size) = (numbers("sides"), numbers("box"));
    assert!(sides[0] >= 0.0 && sides[1] <= size[0], "text sticks out: {found}");
    let mut heights = numbers("heights");
    heights.sort_by(f64::total_cmp);
    assert!(
        heights.windows(2).all(|pair| pair[1] - pair[0] >= 12.0),
        "names run into one another: {found}"
    );
    let phone = visit(&browser, &folder, &on_a_phone(&page), &[]);
    assert_eq!(phone["content"], phone["inner"], "nothing sticks out sideways: {phone}");
}
