//! Lit colours against hw2.md section 7 in float64.

use fixel::error::Error;
use fixel::light::{Finish, Light, Lights, Matte, Shiny};
use fixel::num::{Block, OneStep, Precision, Table, TwoSteps, Word};
use proptest::prelude::*;

const FULL: i32 = 1 << 16;
type Vector = [f64; 3];

/// Where a light is: a direction, or a point in units of the fragment's position.
#[derive(Debug, Clone, Copy)]
enum Place {
    Sun([i32; 3]),
    Bulb([i32; 3]),
}

#[derive(Debug, Clone)]
struct Case {
    lights: Vec<(Place, [i32; 3])>,
    normal: [i32; 3],
    position: [i32; 3],
    surface: [i32; 3],
    /// In units of 2^-16, 0 for none.
    shininess: u32,
    /// Power of two of the positions' unit.
    exponent: i32,
}

impl Case {
    fn core(&self) -> [i32; 3] {
        self.core_at::<TwoSteps>()
    }

    fn core_at<P: Precision>(&self) -> [i32; 3] {
        let mut lights = Lights::<i32, 100, 100, P>::default();
        for &(place, color) in &self.lights {
            let light = match place {
                Place::Sun(towards) => Light::sun(towards, color).unwrap(),
                Place::Bulb(at) => Light::Bulb {
                    position: Block::new(at, self.exponent),
                    color,
                },
            };
            lights.add(light).unwrap();
        }
        let lit = lights.at_scale(self.exponent);
        match self.shininess {
            0 => lit.shade(self.normal, self.position, self.surface, &Matte),
            a => lit.shade(self.normal, self.position, self.surface, &Shiny(a)),
        }
    }

    /// Section 7, in units of 2^-16.
    fn exact(&self) -> Vector {
        let (n, p) = (unit(self.normal.map(f64::from)), self.position.map(f64::from));
        let mut sum = [0.0; 3];
        for (l, light) in self.directions() {
            let c = dot(n, l);
            if c > 0.0 {
                let highlight = match self.shininess {
                    0 => 0.0,
                    a => dot(n, unit(minus(l, unit(p)))).max(0.0).powf(a as f64 / 65536.0),
                };
                for i in 0..3 {
                    sum[i] += c * light[i] * self.surface[i] as f64 / FULL as f64 + light[i] * highlight;
                }
            }
        }
        sum.map(|v| v.clamp(i32::MIN as f64, i32::MAX as f64))
    }

    fn directions(&self) -> impl Iterator<Item = (Vector, Vector)> {
        self.lights.iter().map(|&(place, color)| {
            let l = match place {
                Place::Sun(towards) => towards.map(f64::from),
                Place::Bulb(b) => minus(b.map(f64::from), self.position.map(f64::from)),
            };
            (unit(l), color.map(f64::from))
        })
    }

    /// The error that `src/light.rs` states, in units of 2^-16 per component.
    fn stated(&self) -> Vector {
        let (n, p) = (unit(self.normal.map(f64::from)), self.position.map(f64::from));
        let unit_30 = 1.0 / (1 << 30) as f64;
        let cosine_error = 6.0 * unit_30;
        let mut stated = [1.0; 3];
        for (l, light) in self.directions() {
            let c = dot(n, l);
            let between = minus(l, unit(p));
            let length = dot(between, between).sqrt();
            let (k, k_error) = (
                dot(n, unit(between)),
                (4.0 + 5.0 / length).min((1 << 30) as f64) * unit_30,
            );
            let power = |k: f64| k.clamp(0.0, 1.0).powf(self.shininess as f64 / 65536.0);
            let highlight_error = match self.shininess {
                0 => 0.0,
                _ if c.abs() <= cosine_error => power(k + k_error),
                _ if c < 0.0 => 0.0,
                _ => (power(k + k_error) - power(k)).max(power(k) - power(k - k_error)) + 3.0 * unit_30,
            };
            for i in 0..3 {
                let diffuse_error = if c < -cosine_error { 0.0 } else { cosine_error };
                let surface = (self.surface[i] as f64 / FULL as f64).abs();
                stated[i] += light[i].abs() * (diffuse_error * surface + highlight_error);
            }
        }
        stated
    }

    /// What `src/light/mod.rs` states for the precisions below the exact one.
    fn stated_at<P: Precision>(&self) -> Vector {
        let (n, p) = (unit(self.normal.map(f64::from)), self.position.map(f64::from));
        let unit_30 = 1.0 / (1 << 30) as f64;
        let [of_unit, of_dot, of_power] = [P::UNIT_ERROR, P::DOT_ERROR, P::POWER_ERROR].map(|e| e as f64 * unit_30);
        let exponent = self.shininess as f64 / 65536.0;
        let of_power = of_power * (exponent / 256.0).max(1.0);
        let share = 1.0 / (1 << 15) as f64;
        let brightness: f64 = self
            .directions()
            .map(|(_, light)| light.into_iter().fold(0.0, |a, b| b.abs().max(a)))
            .sum();
        // The least power of two that takes all lights together to 15 bits.
        let step = (brightness.max(1.0).log2().floor() - 14.0).max(0.0).exp2();
        let steps = (self.lights.len() as f64 + 1.0) * step;
        let mut stated = [0, 1, 2].map(|i| {
            let highlight = if self.shininess == 0 { 0.0 } else { steps + step };
            steps * (self.surface[i] as f64 / FULL as f64).abs() + step + highlight
        });
        for (l, light) in self.directions() {
            let c = dot(n, l);
            let between = minus(l, unit(p));
            let length = dot(between, between).sqrt();
            let cosine_error = 3.0 * of_unit + of_dot;
            let k_error = ((3.0 + 4.0 / length) * of_unit + of_dot).min(2.0);
            let k = dot(n, unit(between));
            let power = |k: f64| k.clamp(0.0, 1.0).powf(exponent);
            let highlight_error = match self.shininess {
                0 => 0.0,
                _ if c.abs() <= cosine_error => power(k + k_error) + of_power + share,
                _ if c < 0.0 => 0.0,
                _ => (power(k + k_error) - power(k)).max(power(k) - power(k - k_error)) + of_power + share,
            };
            for i in 0..3 {
                let diffuse_error = if c < -cosine_error { 0.0 } else { cosine_error + share };
                let surface = (self.surface[i] as f64 / FULL as f64).abs();
                stated[i] += light[i].abs() * (diffuse_error * surface + highlight_error);
            }
        }
        stated
    }

    fn share_at<P: Precision>(&self) -> f64 {
        let (core, exact, stated) = (self.core_at::<P>(), self.exact(), self.stated_at::<P>());
        [0, 1, 2]
            .map(|i| (core[i] as f64 - exact[i]).abs() / stated[i])
            .into_iter()
            .fold(0.0, f64::max)
    }

    /// The largest share of the stated error that the core makes use of; 1 is the limit.
    fn share(&self) -> f64 {
        let shares = self
            .errors()
            .into_iter()
            .zip(self.stated())
            .map(|(error, stated)| error / stated);
        shares.fold(0.0, f64::max)
    }

    fn errors(&self) -> Vector {
        let (core, exact) = (self.core(), self.exact());
        [0, 1, 2].map(|i| (core[i] as f64 - exact[i]).abs())
    }
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn unit(v: Vector) -> Vector {
    let length = dot(v, v).sqrt();
    if length == 0.0 { v } else { v.map(|c| c / length) }
}

/// Any length from 1 to 2^30.
fn vector() -> impl Strategy<Value = [i32; 3]> {
    (0..31u32, prop::array::uniform3(-1 << 30..=1i32 << 30)).prop_map(|(cut, v)| v.map(|c| c >> cut))
}

fn direction() -> impl Strategy<Value = [i32; 3]> {
    vector().prop_filter("a sun has a direction", |v| *v != [0; 3])
}

fn place() -> impl Strategy<Value = Place> {
    prop_oneof![direction().prop_map(Place::Sun), vector().prop_map(Place::Bulb)]
}

fn case(brightest: i32) -> impl Strategy<Value = Case> {
    let color = prop::array::uniform3(-brightest..=brightest);
    let lights = prop::collection::vec((place(), color), 0..8);
    let surface = prop::array::uniform3(-2 * FULL..=2 * FULL);
    let one = FULL as u32;
    // None, as steep as k^0.01 at 0, ordinary, and 10^4.
    let shininess = prop_oneof![Just(0), one / 100..one, one..240 * one, 240 * one..10_000 * one];
    (lights, vector(), vector(), surface, shininess, -40..40i32).prop_map(
        |(lights, normal, position, surface, shininess, exponent)| Case {
            lights,
            normal,
            position,
            surface,
            shininess,
            exponent,
        },
    )
}

/// The case with its normal turned to about where the first light is mirrored into the eye.
fn mirrored(mut case: Case, off: [i32; 3]) -> Case {
    let p = unit(case.position.map(f64::from));
    let first = case.directions().next();
    if let Some((l, _)) = first {
        let half = unit(minus(l, p)).map(|c| (c * (1 << 29) as f64) as i32);
        case.normal = [0, 1, 2].map(|i| half[i] + off[i]);
    }
    case
}

/// A finish of someone's own that is not in 0…1.
#[derive(Debug, Clone, Copy)]
struct Careless(i32);

impl Arbitrary for Careless {
    type Parameters = ();
    type Strategy = BoxedStrategy<Self>;
    fn arbitrary_with((): ()) -> Self::Strategy {
        any::<i32>().prop_map(Careless).boxed()
    }
}

impl Finish for Careless {
    const SHINES: bool = true;
    fn strength(&self, _: i32) -> i32 {
        self.0
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn ordinary_lights_are_as_near_as_stated(case in case(3 * FULL)) {
        prop_assert!(case.share() <= 1.0, "{:?} of {:?}", case.errors(), case.stated());
    }

    #[test]
    fn lights_of_16384_are_as_near_as_stated(case in case(16_384 * FULL)) {
        prop_assert!(case.share() <= 1.0, "{:?} of {:?}", case.errors(), case.stated());
    }

    /// Off by up to 1/8, and by up to 2^-14, where exponents of 10^4 fall.
    #[test]
    fn highlights_are_as_near_as_stated(
        case in case(16_384 * FULL),
        off in prop::array::uniform3(-1 << 26..=1i32 << 26),
        less: bool,
    ) {
        let case = mirrored(case, if less { off.map(|c| c >> 11) } else { off });
        prop_assert!(case.share() <= 1.0, "{:?} of {:?}", case.errors(), case.stated());
    }

    /// Below the exact precision.
    #[test]
    fn cheaper_lights_are_as_near_as_stated(
        case in prop_oneof![case(3 * FULL), case(16_384 * FULL)],
        off in prop::array::uniform3(-1 << 26..=1i32 << 26),
    ) {
        for case in [case.clone(), mirrored(case, off)] {
            prop_assert!(case.share_at::<OneStep>() <= 1.0, "{} of one step's error", case.share_at::<OneStep>());
            prop_assert!(case.share_at::<Table>() <= 1.0, "{} of the table's error", case.share_at::<Table>());
        }
    }

    /// A power of two in the normal's length changes nothing, any other factor what rounding does.
    #[test]
    fn the_length_of_a_normal_does_not_matter(
        case in case(3 * FULL),
        normal in prop::array::uniform3(-64..=64i32),
        up in 0..24u32,
    ) {
        let [short, long] = [0, up].map(|up| Case { normal: normal.map(|c| c << up), ..case.clone() });
        prop_assert_eq!(short.core(), long.core());
        let odd = Case { normal: normal.map(|c| c * 33_554_431), ..case };
        prop_assert!(odd.share() <= 1.0);
    }

    /// No input overflows or panics: this profile keeps overflow checks on.
    #[test]
    fn any_numbers_at_all(
        lights in prop::collection::vec((any::<[i64; 3]>(), -200..200i32, any::<[i32; 3]>()), 0..4),
        [normal, position, surface] in any::<[[i32; 3]; 3]>(),
        finish: Careless,
        shininess: u32,
        exponent in prop_oneof![-100..100, any::<i32>()],
    ) {
        let mut scene = Lights::<i64, 4, 4>::default();
        for &(place, power, color) in &lights {
            let bulb = Light::Bulb { position: Block::from_wide(place.map(i128::from), power), color };
            scene.add(bulb).unwrap();
            let sun = Light::Sun { direction: place.map(|c| (c >> 33) as i32), color };
            scene.add(sun).unwrap();
        }
        let lit = scene.at_scale(exponent);
        lit.shade(normal, position, surface, &Matte);
        lit.shade(normal, position, surface, &Shiny(shininess));
        lit.shade(normal, position, surface, &finish);
        cheaper::<Table>(&lights, exponent, [normal, position, surface], &finish, &Shiny(shininess));
        cheaper::<OneStep>(&lights, exponent, [normal, position, surface], &finish, &Shiny(shininess));
    }

    /// To the bit.
    #[test]
    fn the_order_of_lights_does_not_matter(case in case(16_384 * FULL), by in 0..8usize) {
        let mut turned = case.clone();
        turned.lights.rotate_left(by.min(case.lights.len()));
        prop_assert_eq!(case.core(), turned.core());
    }
}

fn cheaper<P: Precision>(
    lights: &[([i64; 3], i32, [i32; 3])],
    exponent: i32,
    [normal, position, surface]: [[i32; 3]; 3],
    careless: &Careless,
    shiny: &Shiny,
) {
    let mut scene = Lights::<i64, 4, 4, P>::default();
    for &(place, power, color) in lights {
        let position = Block::from_wide(place.map(i128::from), power);
        scene.add(Light::Bulb { position, color }).unwrap();
        let direction = place.map(|c| c as i32);
        scene.add(Light::Sun { direction, color }).unwrap();
    }
    let lit = scene.at_scale(exponent);
    lit.shade(normal, position, surface, &Matte);
    lit.shade(normal, position, surface, careless);
    lit.shade(normal, position, surface, shiny);
    lit.shade_wide(normal, position, surface, shiny);
}

/// Splitmix64: the same cases every time.
struct Random(u64);

impl Random {
    fn within(&mut self, limit: i32) -> i32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % (2 * limit as u64 + 1)) as i32 - limit
    }

    fn vector(&mut self, limit: i32) -> [i32; 3] {
        [(); 3].map(|()| self.within(limit))
    }

    /// One with so many lights, half of them bulbs, of colours −2…3.
    fn case(&mut self, lights: usize, shininess: u32) -> Case {
        let lights = (0..lights).map(|i| {
            let place = self.vector(1 << 30);
            let color = self.vector(5 * FULL / 2).map(|c| c + FULL / 2);
            (
                if i % 2 == 0 {
                    Place::Sun(place)
                } else {
                    Place::Bulb(place)
                },
                color,
            )
        });
        Case {
            lights: lights.collect(),
            normal: self.vector(1 << 30),
            position: self.vector(1 << 30),
            surface: self.vector(FULL),
            shininess: shininess << 16,
            exponent: -20,
        }
    }
}

/// One level of 255 in units of 2^-16.
const LEVEL: f64 = FULL as f64 / 255.0;

/// A hundred lights round one highlight, shininess 240: the target is 2 levels.
#[test]
fn a_hundred_lights_are_within_a_hundredth_of_a_level() {
    let mut random = Random(3);
    let mut worst = 0.0f64;
    for _ in 0..20_000 {
        let mut case = random.case(100, 240);
        // The suns all within 1/16 of the first.
        let (Place::Sun(first) | Place::Bulb(first)) = case.lights[0].0;
        for (place, _) in case.lights.iter_mut().step_by(2) {
            let off = random.vector(1 << 26);
            *place = Place::Sun([0, 1, 2].map(|i| first[i] / 2 + off[i]));
        }
        let case = mirrored(case, random.vector(1 << 24));
        worst = case.errors().into_iter().fold(worst, f64::max);
        assert!(case.share() <= 1.0);
    }
    println!("100 lights: {worst:.2} x 2^-16, {:.4} levels", worst / LEVEL);
    assert!(worst < LEVEL / 100.0 && worst > LEVEL / 400.0);
}

/// The stated error is not more than four times what happens.
#[test]
fn the_stated_error_is_tight() {
    let mut random = Random(4);
    let mut worst = [0.0f64; 2];
    for (shininess, worst) in [0, 240].into_iter().zip(&mut worst) {
        for _ in 0..300_000 {
            let mut case = random.case(1, shininess);
            case.lights[0].1 = [16_384 * FULL; 3];
            if random.within(1) == 0 {
                case.lights[0].0 = Place::Bulb(random.vector(1 << 30));
            }
            if shininess > 0 {
                case = mirrored(case, random.vector(1 << 26));
            }
            *worst = worst.max(case.share());
        }
    }
    println!(
        "share of the stated error: diffuse {:.2}, with highlight {:.2}",
        worst[0], worst[1]
    );
    assert!(worst.iter().all(|&w| w > 0.25 && w <= 1.0), "{worst:?}");
}

/// Whose direction is one of those that `Table` has with the largest error (`tests/precision.rs`).
const FAR_OFF: [i32; 3] = [-1_074_102_273, 132_612_094, -189_169_663];

/// At most four times the largest share, as [`the_stated_error_is_tight`] has it: closer around the mirror, and more cases.
#[test]
fn the_stated_error_of_cheaper_lights_is_tight() {
    let mut random = Random(4);
    let mut worst = [[0.0f64; 2]; 2];
    for (shininess, worst) in [0, 240].into_iter().zip(&mut worst) {
        for _ in 0..600_000 {
            let mut case = random.case(1, shininess);
            case.lights[0].1 = [3 * FULL; 3];
            if random.within(1) == 0 {
                case.lights[0].0 = Place::Bulb(random.vector(1 << 30));
            }
            if random.within(1) == 0 {
                case.position = FAR_OFF;
            }
            if shininess > 0 {
                let size = 24 + random.within(2);
                case = mirrored(case, random.vector(1 << size));
            }
            worst[0] = worst[0].max(case.share_at::<OneStep>());
            worst[1] = worst[1].max(case.share_at::<Table>());
        }
    }
    println!(
        "share of the stated error, one step and table: diffuse {:.2?}, with highlight {:.2?}",
        worst[0], worst[1]
    );
    assert!(worst.as_flattened().iter().all(|&w| w > 0.25 && w <= 1.0), "{worst:?}");
}

/// From almost along the surface: c is a few units on either side of 0.
#[test]
fn grazing_light() {
    for step in -4096..=4096 {
        let case = Case {
            lights: vec![(Place::Sun([1 << 30, 0, 0]), [FULL, -FULL, 3 * FULL])],
            normal: [step, 1 << 28, -1 << 20],
            position: [0, -1000, 0],
            surface: [FULL; 3],
            shininess: 0,
            exponent: 0,
        };
        let core = case.core();
        assert!(case.errors().iter().all(|&e| e <= 1.0), "{step}: {core:?}");
        if step <= 0 {
            assert_eq!(core, [0; 3], "{step}");
            assert_eq!(
                Case { shininess: 1, ..case }.core(),
                [0; 3],
                "{step}: no highlight either"
            );
        } else {
            assert_ne!(
                Case { shininess: 1, ..case }.core(),
                [0; 3],
                "{step}: the highlight begins at once"
            );
        }
    }
}

#[test]
fn a_light_at_the_fragment_adds_nothing() {
    let mut case = Random(5).case(4, 10);
    let before = case.core();
    case.lights.push((Place::Bulb(case.position), [3 * FULL; 3]));
    assert_eq!(case.core(), before);
}

#[test]
fn a_fragment_at_the_eye_is_lit() {
    let mut random = Random(6);
    for shininess in [0, 1, 240] {
        let case = Case {
            position: [0; 3],
            ..random.case(5, shininess)
        };
        assert!(case.share() <= 1.0);
    }
}

/// 20000 and −19999 add up to 1; alone, and twice, they reach beyond the range at no harm.
#[test]
fn bright_and_negative_lights_are_clamped_at_the_end_only() {
    let case = |colors: &[i32], surface| Case {
        lights: colors
            .iter()
            .map(|c| (Place::Sun([0, 0, 1]), [c * FULL, -c * FULL, 0]))
            .collect(),
        normal: [0, 0, 5],
        position: [0; 3],
        surface: [surface; 3],
        shininess: 0,
        exponent: 0,
    };
    assert_eq!(case(&[20_000, -19_999], FULL).core(), [FULL, -FULL, 0]);
    assert_eq!(case(&[20_000, 20_000, -20_000, -19_999], FULL).core(), [FULL, -FULL, 0]);
    assert_eq!(case(&[20_000, 20_000], FULL).core(), [i32::MAX, i32::MIN, 0]);
    assert_eq!(
        case(&[20_000, 20_000], -FULL / 4).core(),
        [-10_000 * FULL, 10_000 * FULL, 0]
    );
    assert_eq!(case(&[32_767; 100], i32::MAX).core(), [i32::MAX, i32::MIN, 0]);
    assert_eq!(case(&[32_767; 100], 0).core(), [0; 3]);
}

#[test]
fn a_normal_of_length_0_is_dark() {
    let case = Case {
        normal: [0; 3],
        ..Random(7).case(6, 20)
    };
    assert_eq!(case.core(), [0; 3]);
}

#[test]
fn no_light_is_dark_and_empty() {
    assert!(Lights::<i32, 2, 2>::default().is_empty());
    assert_eq!(Random(8).case(0, 20).core(), [0; 3]);
}

#[test]
fn one_light_too_many_is_an_error() {
    let sun = Light::sun([0, 0, 1], [0; 3]).unwrap();
    let bulb = Light::Bulb {
        position: Block::from_integers([1; 3]),
        color: [0; 3],
    };
    let mut lights = Lights::<i64, 1, 2>::default();
    assert_eq!([sun, bulb, bulb].map(|l| lights.add(l)), [Ok(()); 3]);
    assert_eq!([sun, bulb].map(|l| lights.add(l)), [Err(Error::TooManyLights); 2]);
    assert_eq!(Light::<i64>::sun([0; 3], [0; 3]), Err(Error::ZeroVector));
}

/// A bulb 2^e units away, on either side of what 64 bits hold, is a sun with a parallax of 2^30/2^e.
#[test]
fn a_far_bulb_is_a_sun() {
    fn shade<T: Word, const SUNS: usize, const BULBS: usize>(light: Light<T>, position: [i32; 3]) -> [i32; 3] {
        let mut lights = Lights::<T, SUNS, BULBS>::default();
        lights.add(light).unwrap();
        lights.at_scale(0).shade([1, 1, 1 << 20], position, [FULL; 3], &Matte)
    }
    let towards = [3 << 26, -5 << 26, 2 << 26];
    let color = [16_384 * FULL; 3];
    let sun = shade::<i32, 1, 0>(Light::sun(towards, color).unwrap(), [0; 3]);
    let at = [-1 << 30, 1 << 30, 1 << 29];
    for exponent in 8..1000 {
        let [narrow, wide] = [
            shade::<i32, 0, 1>(
                Light::Bulb {
                    position: Block::new(towards, exponent),
                    color,
                },
                at,
            ),
            shade::<i64, 0, 1>(
                Light::Bulb {
                    position: Block::new(towards.map(i64::from), exponent),
                    color,
                },
                at,
            ),
        ];
        assert_eq!(narrow, wide, "{exponent}");
        let parallax = 0.5f64.powi(exponent - 2);
        let allowed = 16_384.0 * FULL as f64 * (parallax + 12.0 / (1 << 30) as f64);
        let near = |(a, b): (&i32, i32)| (a - b).abs() as f64 <= allowed;
        assert!(wide.iter().zip(sun).all(near), "{exponent}: {wide:?} {sun:?}");
    }
}

/// Bulbs finer than the fragments' unit are rounded to it, to nearest.
#[test]
fn a_bulb_is_rounded_to_the_fragments_unit() {
    let shade = |position: Block<i32, 3>| {
        let mut lights = Lights::<i32, 0, 1>::default();
        lights
            .add(Light::Bulb {
                position,
                color: [FULL; 3],
            })
            .unwrap();
        lights.at_scale(4).shade([1, 2, 3], [0; 3], [FULL; 3], &Matte)
    };
    assert_eq!(
        shade(Block::from_integers([33, 55, 40])),
        shade(Block::from_integers([32, 48, 48]))
    );
    assert_eq!(shade(Block::from_integers([7, 7, 7])), [0; 3]);
    assert_eq!(shade(Block::new([1 << 30; 3], -500)), [0; 3]);
}
