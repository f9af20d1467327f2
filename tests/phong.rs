//! Colours in world space against the lighting rule of `.iv` in float64.

use fixel::error::Error;
use fixel::light::Matte;
use fixel::light::world::{FULL, Glossy, Material, PointLight, PointLights};
use fixel::num::{Block, OneStep, Precision, Table, TwoSteps, Word};
use proptest::prelude::*;

type Vector = [f64; 3];

/// 2^-30, the unit of the stated errors.
const UNIT: f64 = 1.0 / (1 << 30) as f64;

/// Positions are in units of 2^exponent, colours of lights in 2^-16 of full, the material's in 2^-28.
#[derive(Debug, Clone)]
struct Case {
    lights: Vec<([i32; 3], [i32; 3])>,
    normal: [i32; 3],
    position: [i32; 3],
    eye: [i32; 3],
    ambient: [i32; 3],
    diffuse: [i32; 3],
    specular: [i32; 3],
    /// In units of 2^-16, `None` for a matte material.
    shininess: Option<u32>,
    exponent: i32,
}

impl Case {
    fn lights<T: Word, P: Precision>(&self) -> PointLights<T, 100, P> {
        let mut lights = PointLights::new(self.place(self.eye));
        for &(position, color) in &self.lights {
            let light = PointLight {
                position: self.place(position),
                color: Block::new(color, -16),
            };
            lights.add(light).unwrap();
        }
        lights
    }

    fn place<T: Word>(&self, point: [i32; 3]) -> Block<T, 3> {
        Block::new(point.map(T::from_i32), self.exponent)
    }

    /// What `shade` makes of the case's material, given as the type that fits.
    fn by_material<R>(&self, matte: impl Fn(&Material<Matte>) -> R, glossy: impl Fn(&Material<Glossy>) -> R) -> R {
        let (ambient, diffuse) = (self.ambient, self.diffuse);
        match self.shininess {
            None => matte(&Material {
                ambient,
                diffuse,
                specular: Matte,
            }),
            Some(shininess) => glossy(&Material {
                ambient,
                diffuse,
                specular: Glossy {
                    color: self.specular,
                    shininess,
                },
            }),
        }
    }

    /// The three ways to get the colour before the last min(1, ·): by blocks of either word, and by integers.
    fn wide(&self) -> [[i64; 3]; 3] {
        self.wide_at::<TwoSteps>()
    }

    fn wide_at<P: Precision>(&self) -> [[i64; 3]; 3] {
        fn blocks<T: Word, P: Precision>(case: &Case) -> [i64; 3] {
            let (lights, at) = (case.lights::<T, P>(), case.place(case.position));
            case.by_material(
                |m| lights.shade_wide(case.normal, at, m),
                |m| lights.shade_wide(case.normal, at, m),
            )
        }
        let lit = self.lights::<i32, P>().at_scale(self.exponent);
        let (n, p) = (self.normal, self.position);
        let integers = self.by_material(|m| lit.shade_wide(n, p, m), |m| lit.shade_wide(n, p, m));
        [blocks::<i32, P>(self), blocks::<i64, P>(self), integers]
    }

    fn clamped(&self) -> [i32; 3] {
        let lit = self.lights::<i32, TwoSteps>().at_scale(self.exponent);
        let (n, p) = (self.normal, self.position);
        self.by_material(|m| lit.shade(n, p, m), |m| lit.shade(n, p, m))
    }

    /// The rule before the last min(1, ·), and how far from it the core may be, both in full.
    fn exact(&self) -> (Vector, Vector) {
        self.exact_for(
            |length| [6.0, 5.0 + 6.0 / length, 3.0].map(|e| e * UNIT),
            UNIT / 2.0,
            UNIT / 2.0,
            full(1),
        )
    }

    /// As `src/light/world.rs` states for the precisions below the exact one.
    fn exact_at<P: Precision>(&self) -> (Vector, Vector) {
        let [of_unit, of_dot, of_power] = [P::UNIT_ERROR, P::DOT_ERROR, P::POWER_ERROR].map(|e| e as f64 * UNIT);
        let of_power = of_power * (self.shininess.unwrap_or(0) as f64 / 65536.0 / 256.0).max(1.0);
        let share = 1.0 / (1 << 15) as f64;
        let most = |color: [i32; 3]| color.iter().fold(0, |most, c| c.abs().max(most)) as f64 / 65536.0;
        // A unit of 2^-15 for each light is what the core rounds its sum up by.
        let brightness: f64 = self.lights.iter().map(|&(_, color)| most(color) + share).sum();
        let step = (brightness.max(share).log2().floor() + 1.0).max(0.0).exp2() * share;
        self.exact_for(
            |length| {
                [
                    3.0 * of_unit + of_dot + share,
                    (3.0 + 4.0 / length) * of_unit + of_dot,
                    of_power + share,
                ]
            },
            step,
            2.0 * step,
            full(1) + step / 4096.0,
        )
    }

    /// With the errors of a cosine, of n·h for a |unit(e − v) + unit(L − v)|, and of a power; of each light; of the sum; and of
    /// the result.
    fn exact_for(&self, errors_at: impl Fn(f64) -> [f64; 3], each: f64, sum: f64, result: f64) -> (Vector, Vector) {
        let v = self.position.map(f64::from);
        let n = unit(self.normal.map(f64::from));
        let towards = |p: [i32; 3]| unit(minus(p.map(f64::from), v));
        let shininess = self.shininess.unwrap_or(0) as f64 / 65536.0;
        let power = |k: f64| k.clamp(0.0, 1.0).powf(shininess);
        let (mut diffuse, mut specular, mut errors) = ([0.0; 3], [0.0; 3], [[sum - each; 3]; 2]);
        for &(light, color) in &self.lights {
            let l = towards(light);
            let between = plus(towards(self.eye), l);
            let k = dot(n, unit(between)).max(0.0);
            let [cosine_error, k_error, power_error] = errors_at(length(between));
            let k_error = k_error.min(1.0);
            let highlight_error = (power(k + k_error) - power(k)).max(power(k) - power(k - k_error)) + power_error;
            for i in 0..3 {
                let c = color[i] as f64 / 65536.0;
                diffuse[i] += (c * dot(n, l)).max(0.0);
                specular[i] += (c * power(k)).max(0.0);
                errors[0][i] += c.abs() * cosine_error + each;
                errors[1][i] += c.abs() * highlight_error + each;
            }
        }
        let s = if self.shininess.is_some() {
            self.specular
        } else {
            [0; 3]
        };
        let color = [0, 1, 2]
            .map(|i| full(self.ambient[i]) + diffuse[i].min(1.0) * full(self.diffuse[i]) + specular[i] * full(s[i]));
        let stated =
            [0, 1, 2].map(|i| errors[0][i] * full(self.diffuse[i]).abs() + errors[1][i] * full(s[i]).abs() + result);
        (color, stated)
    }

    /// The largest share of the stated error that the core makes use of; 1 is the limit.
    fn share(&self) -> f64 {
        Self::largest_share(self.wide(), self.exact())
    }

    fn share_at<P: Precision>(&self) -> f64 {
        Self::largest_share(self.wide_at::<P>(), self.exact_at::<P>())
    }

    fn largest_share(wide: [[i64; 3]; 3], (exact, stated): (Vector, Vector)) -> f64 {
        let mut worst = 0.0f64;
        for core in wide {
            for i in 0..3 {
                let off = (core[i] as f64 / FULL as f64 - exact[i]).abs();
                worst = worst.max(off / stated[i]);
            }
        }
        worst
    }
}

fn full(v: i32) -> f64 {
    v as f64 / FULL as f64
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn plus(a: Vector, b: Vector) -> Vector {
    minus(a, b.map(|c| -c))
}

fn length(v: Vector) -> f64 {
    dot(v, v).sqrt()
}

fn unit(v: Vector) -> Vector {
    let length = length(v);
    if length == 0.0 { v } else { v.map(|c| c / length) }
}

/// Any length from 0 to 2^30.
fn vector() -> impl Strategy<Value = [i32; 3]> {
    (0..31u32, prop::array::uniform3(-1 << 30..=1i32 << 30)).prop_map(|(cut, v)| v.map(|c| c >> cut))
}

fn shininess() -> impl Strategy<Value = Option<u32>> {
    let one = 1u32 << 16;
    let special = prop::sample::select(vec![0, 66, 13_107, one, 10 * one, 240 * one, 10_000 * one]);
    prop_oneof![1 => Just(None), 4 => special.prop_map(Some), 1 => (0..300 * one).prop_map(Some)]
}

/// Colours of lights from −2 to 3.
fn color() -> impl Strategy<Value = [i32; 3]> {
    prop::array::uniform3(-2 << 16..=3i32 << 16)
}

fn case(most_lights: usize) -> impl Strategy<Value = Case> {
    let surface = || prop::array::uniform3(prop_oneof![0..=FULL, Just(0), Just(FULL)]);
    let lights = prop::collection::vec((vector(), color()), 0..=most_lights);
    (
        lights,
        [vector().boxed(), vector().boxed(), vector().boxed()],
        [surface().boxed(), surface().boxed(), surface().boxed()],
        shininess(),
        -100..100i32,
    )
        .prop_map(
            |(lights, [normal, position, eye], [ambient, diffuse, specular], shininess, exponent)| Case {
                lights,
                normal,
                position,
                eye,
                ambient,
                diffuse,
                specular,
                shininess,
                exponent,
            },
        )
}

/// With the normal turned to about where the first light is mirrored into the eye.
fn mirrored(mut case: Case, off: [i32; 3]) -> Case {
    if let Some(&(light, _)) = case.lights.first() {
        let towards = |p: [i32; 3]| unit(minus(p.map(f64::from), case.position.map(f64::from)));
        let half = unit(plus(towards(light), towards(case.eye)));
        case.normal = [0, 1, 2].map(|i| (half[i] * (1 << 29) as f64) as i32 + off[i]);
    }
    case
}

/// With the eye, the point and the first light on a line but for `off`, the point in the middle.
fn opposite(mut case: Case, along: [i32; 3], times: i32, off: [i32; 3]) -> Case {
    case.position = case.position.map(|c| c >> 4);
    let p = case.position;
    case.eye = [0, 1, 2].map(|i| p[i] + along[i]);
    if let Some((light, _)) = case.lights.first_mut() {
        *light = [0, 1, 2].map(|i| p[i] - along[i] * times + off[i]);
    }
    case
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

    fn case(&mut self, lights: usize, shininess: Option<u32>) -> Case {
        let mut light = || (self.vector(1 << 29), self.vector(5 << 15).map(|c| c + (1 << 15)));
        Case {
            lights: (0..lights).map(|_| light()).collect(),
            normal: self.vector(1 << 30),
            position: self.vector(1 << 29),
            eye: self.vector(1 << 29),
            ambient: [0; 3],
            diffuse: [FULL; 3],
            specular: [FULL; 3],
            shininess: shininess.map(|x| x << 16),
            exponent: -20,
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn colors_are_as_near_as_stated(case in case(6)) {
        prop_assert!(case.share() <= 1.0, "{:?} not near {:?}", case.wide(), case.exact());
    }

    /// Off the mirrored direction by up to 1/8, and by up to 2^-14, where exponents of 10^4 fall.
    #[test]
    fn highlights_are_as_near_as_stated(
        case in case(4), off in prop::array::uniform3(-1 << 26..=1i32 << 26), less: bool,
    ) {
        let case = mirrored(case, if less { off.map(|c| c >> 11) } else { off });
        prop_assert!(case.share() <= 1.0, "{:?} not near {:?}", case.wide(), case.exact());
    }

    /// Below the exact precision.
    #[test]
    fn cheaper_lights_are_as_near_as_stated(case in case(5), off in prop::array::uniform3(-1 << 26..=1i32 << 26)) {
        for case in [case.clone(), mirrored(case, off)] {
            prop_assert!(case.share_at::<OneStep>() <= 1.0, "{} of one step's error", case.share_at::<OneStep>());
            prop_assert!(case.share_at::<Table>() <= 1.0, "{} of the table's error", case.share_at::<Table>());
        }
    }

    /// Light from exactly or almost behind, where the half vector is all cancellation.
    #[test]
    fn opposite_lights_are_as_near_as_stated(
        case in case(2), along in prop::array::uniform3(-1 << 26..=1i32 << 26), times in 1..8i32,
        off in prop::array::uniform3(-1 << 20..=1i32 << 20), cut in 0..21u32,
    ) {
        let case = opposite(case, along, times, off.map(|c| c >> cut));
        prop_assert!(case.share() <= 1.0, "{:?} not near {:?}", case.wide(), case.exact());
    }

    /// A light, the eye, or both exactly at the point.
    #[test]
    fn lights_and_eyes_at_the_point_have_no_direction(case in case(3), light: bool, eye: bool) {
        let mut case = case;
        if let (true, Some(first)) = (light, case.lights.first_mut()) {
            first.0 = case.position;
        }
        if eye {
            case.eye = case.position;
        }
        prop_assert!(case.share() <= 1.0, "{:?} not near {:?}", case.wide(), case.exact());
    }

    #[test]
    fn colors_stop_at_full(case in case(6)) {
        let [.., wide] = case.wide();
        prop_assert_eq!(case.clamped(), wide.map(|c| c.min(FULL as i64) as i32));
    }

    /// To the bit.
    #[test]
    fn the_order_of_lights_does_not_matter(case in case(6), by in 0..6usize) {
        let mut turned = case.clone();
        turned.lights.rotate_left(by.min(case.lights.len()));
        prop_assert_eq!(case.wide(), turned.wide());
    }

    /// No input overflows or panics: this profile keeps overflow checks on.
    #[test]
    fn any_numbers_at_all(
        lights in prop::collection::vec((any::<[i64; 3]>(), -200..200i32, any::<[i32; 3]>(), any::<i32>()), 0..4),
        [normal, position, ambient] in any::<[[i32; 3]; 3]>(),
        [diffuse, color] in any::<[[i32; 3]; 2]>(),
        [eye, at] in any::<[[i64; 3]; 2]>(),
        (scale, at_scale) in (-200..200i32, prop_oneof![-200..200i32, any::<i32>()]),
        shininess: u32, exponent in prop_oneof![-100..100, any::<i32>()],
    ) {
        let block = |v: [i64; 3], e| Block::<i64, 3>::from_wide(v.map(i128::from), e);
        let mut scene = PointLights::<i64, 4>::new(block(eye, scale));
        let mut cheaper = PointLights::<i64, 4, Table>::new(block(eye, scale));
        for (place, power, color, brightness) in lights {
            let color = Block::from_wide(color.map(i64::from), brightness);
            let light = PointLight { position: block(place, power), color };
            scene.add(light).unwrap();
            cheaper.add(light).unwrap();
        }
        let matte = Material { ambient, diffuse, specular: Matte };
        let glossy = Material { ambient, diffuse, specular: Glossy { color, shininess } };
        let (lit, at) = (scene.at_scale(exponent), block(at, at_scale));
        scene.shade(normal, at, &matte);
        scene.shade(normal, at, &glossy);
        lit.shade(normal, position, &matte);
        lit.shade(normal, position, &glossy);
        cheaper.shade(normal, at, &glossy);
        cheaper.at_scale(exponent).shade(normal, position, &glossy);
        cheaper.at_scale(exponent).shade_wide(normal, position, &matte);
    }
}

/// At most four times what happens, for the precisions below the exact one.
#[test]
fn the_stated_error_of_cheaper_lights_is_tight() {
    let mut random = Random(5);
    for shininess in [None, Some(240)] {
        let mut worst = [0.0f64; 2];
        for _ in 0..200_000 {
            let mut case = random.case(1, shininess);
            if shininess.is_none() {
                (case.lights[0].1, case.diffuse) = ([(1 << 16) - 1; 3], [FULL; 3]);
            } else {
                (case.lights[0].1, case.diffuse) = ([3 << 16; 3], [0; 3]);
                case = mirrored(case, random.vector(1 << 26));
            }
            worst[0] = worst[0].max(case.share_at::<OneStep>());
            worst[1] = worst[1].max(case.share_at::<Table>());
        }
        println!("{shininess:?}: {worst:.2?} of the stated error, one step and table");
        assert!(worst.iter().all(|&w| w > 0.25 && w <= 1.0), "{worst:?}");
    }
}

/// The stated error is not more than four times what happens, and a hundred lights stay within 2^-25 of full.
#[test]
fn the_stated_error_is_tight() {
    let mut random = Random(4);
    for shininess in [None, Some(240)] {
        let mut worst = 0.0f64;
        for _ in 0..200_000 {
            let mut case = random.case(1, shininess);
            if shininess.is_none() {
                // As much of D as there is room for before it is cut.
                (case.lights[0].1, case.diffuse) = ([1 << 16; 3], [i32::MAX; 3]);
            } else {
                (case.lights[0].1, case.diffuse) = ([16_000 << 16; 3], [0; 3]);
                case = mirrored(case, random.vector(1 << 26));
            }
            worst = worst.max(case.share());
        }
        println!("{shininess:?}: {worst:.2} of the stated error");
        assert!(worst > 0.25 && worst <= 1.0, "{worst}");
    }
    let mut worst = 0.0f64;
    for _ in 0..2000 {
        let case = Case {
            // Weak enough for D to stay below 1.
            lights: random
                .case(100, None)
                .lights
                .into_iter()
                .map(|(l, c)| (l, c.map(|c| c >> 6)))
                .collect(),
            ..random.case(0, None)
        };
        let (exact, _) = case.exact();
        for core in case.wide() {
            worst = (0..3)
                .map(|i| (core[i] as f64 / FULL as f64 - exact[i]).abs())
                .fold(worst, f64::max);
        }
    }
    println!("100 lights: 2^{:.1} of full", worst.log2());
    assert!(worst < 0.5f64.powi(25));
}

fn head_on(color: f64, shininess: Option<u32>, normal: [i32; 3]) -> Case {
    Case {
        lights: vec![([0, 0, 9], [(color * 65536.0) as i32; 3])],
        normal,
        position: [0; 3],
        eye: [0, 0, 5],
        ambient: [0; 3],
        diffuse: [FULL / 2; 3],
        specular: [FULL / 4; 3],
        shininess,
        exponent: 0,
    }
}

/// D is cut at 1, S is not; each light and component at 0 by itself.
#[test]
fn clamps_are_where_the_rule_has_them() {
    let colors = |case: Case| case.wide()[2].map(|c| c as f64 / FULL as f64)[0];
    assert_eq!(colors(head_on(3.0, None, [0, 0, 1])), 0.5);
    assert_eq!(colors(head_on(3.0, Some(5 << 16), [0, 0, 1])), 0.5 + 0.75);
    assert_eq!(head_on(3.0, Some(5 << 16), [0, 0, 1]).clamped(), [FULL; 3]);
    // A negative light takes nothing away, and shines on what is turned away from it.
    assert_eq!(colors(head_on(-0.5, Some(5 << 16), [0, 0, 1])), 0.0);
    assert_eq!(colors(head_on(-0.5, Some(5 << 16), [0, 0, -1])), 0.25);
    let mut two = head_on(0.5, None, [0, 0, 1]);
    two.lights.push(([0, 0, 2], [-1 << 16; 3]));
    assert_eq!(colors(two), 0.25);
    // The highlight is not switched off behind the surface.
    let mut behind = head_on(1.0, Some(1 << 16), [0, 0, 1]);
    (behind.lights[0].0, behind.eye) = ([4, 0, -3], [0, 0, 1]);
    assert!(behind.exact().0[0] > 0.05 && behind.share() <= 1.0);
}

/// 0^0 is 1: with shininess 0 every light of positive colour adds all of itself, whatever the directions.
#[test]
fn shininess_0_is_a_highlight_everywhere() {
    for normal in [[0, 0, 0], [0, 0, -1], [1, 0, 0], [0, 0, 1]] {
        for eye in [[0, 0, 0], [0, 0, -9], [3, 4, 5]] {
            let mut case = head_on(1.0, Some(0), normal);
            (case.eye, case.diffuse) = (eye, [0; 3]);
            assert_eq!(case.wide(), [[FULL as i64 / 4; 3]; 3]);
            case.shininess = Some(1);
            assert!(normal != [0; 3] || case.wide() == [[0; 3]; 3]);
        }
    }
}

/// Beyond what 64 bits hold at the fragments' scale, a light or eye is as far as it gets.
#[test]
fn far_lights_and_eyes() {
    let shade = |exponent: i32| {
        let mut lights = PointLights::<i32, 1>::new(Block::new([-3, 1, 8], exponent));
        lights
            .add(PointLight {
                position: Block::new([1, 2, 7], exponent),
                color: Block::from_integers([1; 3]),
            })
            .unwrap();
        let specular = Glossy {
            color: [FULL / 2; 3],
            shininess: 7 << 16,
        };
        let material = Material {
            ambient: [0; 3],
            diffuse: [FULL / 2; 3],
            specular,
        };
        lights.at_scale(0).shade([0, 1, 5], [1 << 30, -1 << 30, 9], &material)
    };
    let far = shade(1000);
    for exponent in 58..1000 {
        assert!(
            shade(exponent).iter().zip(far).all(|(a, b)| a.abs_diff(b) <= 32),
            "{exponent}"
        );
    }
}

/// Colours of any size.
#[test]
fn bright_and_dim_lights() {
    let red = |color: Block<i32, 3>, diffuse| {
        let mut lights = PointLights::<i32, 1>::new(Block::ZERO);
        lights
            .add(PointLight {
                position: Block::from_integers([0, 0, 1]),
                color,
            })
            .unwrap();
        let material = Material {
            ambient: [0; 3],
            diffuse: [diffuse; 3],
            specular: Matte,
        };
        lights.shade([0, 0, 1], Block::ZERO, &material)[0]
    };
    for exponent in 0..1000 {
        assert_eq!(red(Block::new([1; 3], exponent), FULL), FULL);
        assert_eq!(red(Block::new([-1; 3], exponent), FULL), 0);
        // 2^-29 of full is rounded up.
        let wanted = if exponent == 29 { 1 } else { FULL >> exponent.min(30) };
        assert_eq!(red(Block::new([1; 3], -exponent), FULL), wanted, "{exponent}");
    }
}

#[test]
fn one_light_too_many_is_an_error() {
    let light = PointLight {
        position: Block::from_integers([1; 3]),
        color: Block::ZERO,
    };
    let mut lights = PointLights::<i32, 2>::new(Block::ZERO);
    assert_eq!([light; 2].map(|l| lights.add(l)), [Ok(()); 2]);
    assert_eq!(lights.add(light), Err(Error::TooManyLights));
}
