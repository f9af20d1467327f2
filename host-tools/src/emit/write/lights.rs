//! The text of a scene's lights.

use std::fmt::Write;

use fixel::light::Light;

use crate::emit::drawing::Lights;

/// How many are at a point.
pub fn bulbs(lights: &[Light<i64>]) -> usize {
    lights.iter().filter(|l| matches!(l, Light::Bulb { .. })).count()
}

/// Tables of the set with a number, and the function that makes lights of them.
pub fn text(number: usize, lights: &Lights) -> String {
    match lights {
        Lights::Eye(lights) => eye(number, lights),
        Lights::World(eye, lights) => {
            let mut rows = String::new();
            for light in lights {
                let (place, color) = (light.position, light.color);
                let _ = writeln!(
                    rows,
                    "    ({:?}, {}, {:?}, {}),",
                    place.mantissas(),
                    place.exponent(),
                    color.mantissas(),
                    color.exponent()
                );
            }
            let count = lights.len();
            format!(
                "/// Places and colours of lights, each times two to the power behind it.
#[rustfmt::skip]
static LIGHTS_{number}: [([i64; 3], i32, [i32; 3], i32); {count}] = [
{rows}];

/// The eye's place times two to the power behind it.
#[rustfmt::skip]
static EYE_{number}: ([i64; 3], i32) = ({:?}, {});

fn lights_{number}() -> PointLights<i64, {count}> {{
    let (place, exponent) = EYE_{number};
    let mut lights = PointLights::new(Block::new(place, exponent));
    for &(place, exponent, color, power) in &LIGHTS_{number} {{
        // There is room for all.
        let _ = lights.add(PointLight {{
            position: Block::new(place, exponent),
            color: Block::new(color, power),
        }});
    }}
    lights
}}

",
                eye.mantissas(),
                eye.exponent()
            )
        }
    }
}

fn eye(number: usize, lights: &[Light<i64>]) -> String {
    let (mut suns, mut bulbs) = (String::new(), String::new());
    let (mut sun_count, mut bulb_count) = (0, 0);
    for light in lights {
        match light {
            Light::Sun { direction, color } => {
                sun_count += 1;
                let _ = writeln!(suns, "    ({direction:?}, {color:?}),");
            }
            Light::Bulb { position, color } => {
                bulb_count += 1;
                let _ = writeln!(
                    bulbs,
                    "    ({:?}, {}, {color:?}),",
                    position.mantissas(),
                    position.exponent()
                );
            }
        }
    }
    let mut text = String::new();
    let mut body = String::new();
    if sun_count > 0 {
        let _ = write!(
            text,
            "/// Directions and colours of lights that are far away.
#[rustfmt::skip]
static SUNS_{number}: [([i32; 3], [i32; 3]); {sun_count}] = [
{suns}];

"
        );
        let _ = write!(
            body,
            "    for &(direction, color) in &SUNS_{number} {{
        // There is room for all.
        let _ = lights.add(Light::Sun {{ direction, color }});
    }}
"
        );
    }
    if bulb_count > 0 {
        let _ = write!(
            text,
            "/// Places of lights, each times two to the power behind it, and their colours.
#[rustfmt::skip]
static BULBS_{number}: [([i64; 3], i32, [i32; 3]); {bulb_count}] = [
{bulbs}];

"
        );
        let _ = write!(
            body,
            "    for &(place, exponent, color) in &BULBS_{number} {{
        // There is room for all.
        let _ = lights.add(Light::Bulb {{
            position: Block::new(place, exponent),
            color,
        }});
    }}
"
        );
    }
    text + &format!(
        "fn lights_{number}() -> Lights<i64, {sun_count}, {bulb_count}> {{
    let mut lights = Lights::default();
{body}    lights
}}

"
    )
}
