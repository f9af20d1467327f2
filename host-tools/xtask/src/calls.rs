//! Who calls whom in an image of Thumb code, as its branches say.

use std::collections::{BTreeMap, BTreeSet};

use crate::elf::{Elf, Function};

/// The calls between the functions of an image.
#[derive(Debug, Default)]
pub struct Calls<'a> {
    /// By name: whom each function calls, itself too where it does.
    pub direct: BTreeMap<&'a str, BTreeSet<&'a str>>,
    /// Functions that call what a register holds.
    pub indirect: BTreeSet<&'a str>,
}

/// What an instruction does to the flow that leaves a function.
#[derive(Debug, PartialEq, Eq)]
enum Flow {
    /// Calls this address.
    Call(u32),
    /// Goes there: a jump, or a call that is the last thing done.
    Jump(u32),
    /// Calls, or goes to, what a register holds.
    Indirect,
}

impl<'a> Calls<'a> {
    /// Of the functions of `image`.
    pub fn of(image: &Elf<'a>) -> Self {
        let mut functions = image.functions();
        functions.sort_by_key(|function| function.address);
        let marks = image.code_marks();
        let mut calls = Calls::default();
        for function in &functions {
            let callees = calls.direct.entry(function.name).or_default();
            for flow in flows(function, &marks) {
                let (target, is_call) = match flow {
                    Flow::Call(target) => (target, true),
                    Flow::Jump(target) => (target, false),
                    Flow::Indirect => {
                        calls.indirect.insert(function.name);
                        continue;
                    }
                };
                // Within a function a jump is a loop, and so is a call of anything but its start: where there is no long
                // jump (ARMv6-M), the compiler jumps by the instruction that calls.
                if let Some(callee) = at(&functions, target)
                    && (callee.address != function.address || is_call && target == function.address)
                {
                    callees.insert(callee.name);
                }
            }
        }
        calls
    }

    /// A way from a function back to itself, if there is one.
    pub fn recursion(&self) -> Option<Vec<&'a str>> {
        let mut done = BTreeSet::new();
        self.direct
            .keys()
            .find_map(|name| self.walk(name, &mut Vec::new(), &mut done))
    }

    fn walk(&self, name: &'a str, path: &mut Vec<&'a str>, done: &mut BTreeSet<&'a str>) -> Option<Vec<&'a str>> {
        if let Some(start) = path.iter().position(|&caller| caller == name) {
            return Some(path[start..].to_vec());
        }
        if done.contains(name) {
            return None;
        }
        path.push(name);
        let callees = self.direct.get(name).into_iter().flatten();
        let found = callees.into_iter().find_map(|callee| self.walk(callee, path, done));
        path.pop();
        done.insert(name);
        found
    }
}

/// The function that an address lies in.
fn at<'f, 'a>(functions: &'f [Function<'a>], address: u32) -> Option<&'f Function<'a>> {
    let after = functions.partition_point(|function| function.address <= address);
    // Names of one function stand together: the first stands for all.
    let last = functions[..after].last()?;
    let lies_in = address < last.address + last.code.len() as u32;
    functions.iter().find(|f| lies_in && f.address == last.address)
}

/// Branches of a function, constants between its code left out.
fn flows(function: &Function<'_>, marks: &[(u32, bool)]) -> Vec<Flow> {
    let mut found = Vec::new();
    let half = |offset: usize| {
        let bytes = function.code.get(offset..)?.first_chunk()?;
        Some(u16::from_le_bytes(*bytes))
    };
    let mut offset = 0;
    while let Some(first) = half(offset) {
        let address = function.address + offset as u32;
        let before = marks.partition_point(|&(start, _)| start <= address);
        let is_code = marks[..before].last().is_none_or(|&(_, is_code)| is_code);
        // Of 32 bits are those that begin with 11101, 11110, 11111.
        let is_wide = is_code && first >> 11 >= 0b11101;
        if is_code {
            let second = if is_wide { half(offset + 2) } else { None };
            found.extend(flow(address, first, second));
        }
        offset += if is_wide { 4 } else { 2 };
    }
    found
}

/// The flow of one instruction; a branch counts from 4 bytes behind its own address.
fn flow(address: u32, first: u16, second: Option<u16>) -> Option<Flow> {
    let to = |distance: i32| address.wrapping_add(4).wrapping_add_signed(distance);
    let Some(second) = second else {
        let register = first >> 3 & 15;
        return match first {
            // blx register, and bx register but for the return by lr.
            _ if first & 0xff87 == 0x4780 => Some(Flow::Indirect),
            _ if first & 0xff87 == 0x4700 && register != 14 => Some(Flow::Indirect),
            // b, and b under a condition, of which 1110 and 1111 are others.
            _ if first >> 11 == 0b11100 => Some(Flow::Jump(to(signed(first.into(), 11) * 2))),
            _ if first >> 12 == 0b1101 && first >> 9 & 7 != 7 => Some(Flow::Jump(to(signed(first.into(), 8) * 2))),
            _ => None,
        };
    };
    if first >> 11 != 0b11110 || second >> 15 == 0 {
        return None;
    }
    let (first, second) = (u32::from(first), u32::from(second));
    let (sign, j1, j2) = (first >> 10 & 1, second >> 13 & 1, second >> 11 & 1);
    let low = second & 0x7ff;
    // Of a long branch: sign, two bits that are turned over where it is 0, 10 and 11 bits.
    let long = || {
        let (i1, i2) = (j1 ^ sign ^ 1, j2 ^ sign ^ 1);
        signed(sign << 23 | i1 << 22 | i2 << 21 | (first & 0x3ff) << 11 | low, 24) * 2
    };
    match (second >> 14 & 1, second >> 12 & 1) {
        (1, 1) => Some(Flow::Call(to(long()))),
        (0, 1) => Some(Flow::Jump(to(long()))),
        // Under a condition; 111x are barriers and system registers.
        (0, 0) if first >> 7 & 7 != 7 => {
            let distance = sign << 19 | j2 << 18 | j1 << 17 | (first & 0x3f) << 11 | low;
            Some(Flow::Jump(to(signed(distance, 20) * 2)))
        }
        _ => None,
    }
}

/// The lowest `bits` as a signed number.
fn signed(value: u32, bits: u32) -> i32 {
    (value << (32 - bits)) as i32 >> (32 - bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn branches_are_read_as_the_assembler_writes_them() {
        // As arm-none-eabi-objdump shows them.
        let cases = [
            (0x8000, 0xf000, Some(0xf802), Some(Flow::Call(0x8008))), // bl 8008
            (0x8000, 0xf7ff, Some(0xfffe), Some(Flow::Call(0x8000))), // bl 8000
            (0x8000, 0xf000, Some(0xb801), Some(Flow::Jump(0x8006))), // b.w 8006
            (0x8000, 0xf43f, Some(0xaffe), Some(Flow::Jump(0x8000))), // beq.w 8000
            (0x8000, 0xe7fe, None, Some(Flow::Jump(0x8000))),         // b.n 8000
            (0x8000, 0xd0fe, None, Some(Flow::Jump(0x8000))),         // beq.n 8000
            (0x8000, 0x4798, None, Some(Flow::Indirect)),             // blx r3
            (0x8000, 0x4718, None, Some(Flow::Indirect)),             // bx r3
            (0x8000, 0x4770, None, None),                             // bx lr
            (0x8000, 0xdf00, None, None),                             // svc 0
            (0x8000, 0xf3bf, Some(0x8f5f), None),                     // dmb sy
        ];
        for (address, first, second, wanted) in cases {
            assert_eq!(flow(address, first, second), wanted, "{first:04x} {second:04x?}");
        }
    }

    #[test]
    fn recursion_is_found_direct_and_by_way_of_others() {
        let calls = |pairs: &[(&'static str, &'static str)]| {
            let mut calls = Calls::default();
            for &(caller, callee) in pairs {
                calls.direct.entry(caller).or_default().insert(callee);
            }
            calls.recursion()
        };
        assert_eq!(calls(&[("a", "b"), ("a", "c"), ("b", "c")]), None);
        assert_eq!(calls(&[("a", "a")]), Some(vec!["a"]));
        assert_eq!(calls(&[("a", "b"), ("b", "c"), ("c", "b")]), Some(vec!["b", "c"]));
    }

    #[test]
    fn constants_are_no_branches() {
        // bl to itself; then the same bytes as a constant.
        let function = Function {
            name: "f",
            address: 0x100,
            code: &[0xff, 0xf7, 0xfe, 0xff, 0xff, 0xf7, 0xfe, 0xff],
        };
        assert_eq!(flows(&function, &[(0x100, true), (0x104, false)]), [Flow::Call(0x100)]);
    }
}
