//! On the host: `rivals FILE LINE` draws a workload, such as `euc/W2`, for valgrind to count; `rivals FILE SET RIVAL` writes
//! which pixels each triangle of a set covers, a byte a pixel.

use std::io::{self, Write};
use std::process::ExitCode;
use std::{env, fs};

use fixel_rivals::embedded_3dgfx::Embedded3dgfx;
use fixel_rivals::embedded_graphics::EmbeddedGraphics;
use fixel_rivals::euc::Euc;
use fixel_rivals::retrofire::Retrofire;
use fixel_rivals::scene::{Triangle, triangles};
use fixel_rivals::{Kind, Rival, run};
use fixel_workloads::machine::{Line, Machine};

/// Prints lines; valgrind counts.
struct Host;

impl Machine for Host {
    fn count(&mut self, work: impl FnOnce()) -> u32 {
        counted_region(work);
        0
    }

    fn report(&mut self, line: &Line<'_>) {
        println!("{line}");
    }
}

/// Valgrind counts in here, by name.
#[inline(never)]
fn counted_region(work: impl FnOnce()) {
    work();
}

fn main() -> ExitCode {
    let arguments: Vec<_> = env::args().skip(1).collect();
    let done = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [file, line] => fs::read(file).map(|file| run::run(&mut Host, &file, |name| name == line)),
        [file, set, rival] => fs::read(file).and_then(|file| write_coverage(rival, &triangles(&file, set))),
        _ => Err(io::Error::other("usage: rivals FILE LINE, or rivals FILE SET RIVAL")),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn write_coverage(rival: &str, triangles: &[Triangle]) -> io::Result<()> {
    match rival {
        Euc::NAME => cover::<Euc>(triangles),
        Retrofire::NAME => cover::<Retrofire>(triangles),
        Embedded3dgfx::NAME => cover::<Embedded3dgfx>(triangles),
        EmbeddedGraphics::NAME => cover::<EmbeddedGraphics>(triangles),
        _ => Err(io::Error::other("no such rival")),
    }
}

/// Triangles of the sets are white: what is not black is covered.
fn cover<R: Rival>(triangles: &[Triangle]) -> io::Result<()> {
    let mut output = io::stdout().lock();
    for &triangle in triangles {
        let mut frame = R::frame();
        if let Some(prepared) = R::prepare(Kind::Flat, &[triangle]) {
            R::draw(&prepared, &mut frame);
        }
        let covered: Vec<u8> = R::colors(&frame).iter().map(|&color| u8::from(color != 0)).collect();
        output.write_all(&covered)?;
    }
    Ok(())
}
