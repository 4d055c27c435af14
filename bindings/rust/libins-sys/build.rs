//! Compiles the C core (core/src/*.c) for the target with a C compiler, and tells rustc to link it.
//!
//! Compiler, archiver and flags come from CC_<target>, TARGET_CC or CC, and likewise AR and CFLAGS, as the cc crate names them; without
//! them from the table below, or `cc` and `ar` when the target is the host.
//! SPDX-License-Identifier: MIT
use std::path::{Path, PathBuf};
use std::process::{exit, Command};
use std::{env, fs};

/// Start of the target's name, prefix of its GNU tools, code generation flags.
const CROSS: [(&str, &str, &[&str]); 7] = [
    ("thumbv6m-none-eabi", "arm-none-eabi-", &["-mcpu=cortex-m0", "-mthumb"]),
    ("thumbv7m-none-eabi", "arm-none-eabi-", &["-mcpu=cortex-m3", "-mthumb"]),
    ("thumbv7em-none-eabihf", "arm-none-eabi-", &["-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16"]),
    ("thumbv7em-none-eabi", "arm-none-eabi-", &["-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=soft"]),
    ("armv5te-none-eabi", "arm-none-eabi-", &["-march=armv5te", "-marm", "-mfloat-abi=soft"]),
    ("riscv32imac-unknown-none-elf", "riscv64-unknown-elf-", &["-march=rv32imac", "-mabi=ilp32", "-mcmodel=medany"]),
    ("arm-unknown-linux-gnueabi", "arm-linux-gnueabi-", &[]),
];

fn fail(message: &str) -> ! {
    println!("cargo::error=libins-sys: {message}");
    exit(1)
}

fn variable(name: &str) -> String {
    env::var(name).unwrap_or_else(|_| fail(&format!("{name} is not set: build.rs is run by cargo")))
}

/// NAME_<target>, with - as _ too; TARGET_NAME; NAME.
fn chosen(name: &str, target: &str) -> Option<String> {
    [format!("{name}_{target}"), format!("{name}_{}", target.replace('-', "_")), format!("TARGET_{name}"), name.into()].iter().find_map(
        |key| {
            println!("cargo::rerun-if-env-changed={key}");
            env::var(key).ok()
        },
    )
}

/// Runs all at once, and waits.
fn run(commands: Vec<Command>) {
    let start = |mut command: Command| match command.spawn() {
        Ok(child) => (command, child),
        Err(error) => fail(&format!("{command:?}: {error}. Set CC_<target> and AR_<target> to the tools of the target")),
    };
    let running: Vec<_> = commands.into_iter().map(start).collect();
    for (command, mut child) in running {
        match child.wait() {
            Ok(status) if status.success() => {}
            other => fail(&format!("{command:?} ended with {other:?}")),
        }
    }
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| fail(&format!("{}: {error}. The C core belongs there", folder.display())));
    let mut list: Vec<PathBuf> =
        entries.flatten().map(|entry| entry.path()).filter(|path| path.extension().is_some_and(|e| e == "c")).collect();
    list.sort();
    list
}

fn main() {
    let float = match (env::var_os("CARGO_FEATURE_DOUBLE"), env::var_os("CARGO_FEATURE_FLOAT")) {
        (Some(_), None) => false,
        (None, Some(_)) => true,
        _ => fail("choose exactly one of the features `double` (default) and `float` (with default-features = false)"),
    };
    let target = variable("TARGET");
    let row = CROSS.iter().find(|row| row.0 == target);
    let prefix = if target == variable("HOST") { Some("") } else { row.map(|row| row.1) };
    let tool = |name: &str, default: &str| {
        let known = || prefix.map(|prefix| format!("{prefix}{default}"));
        chosen(name, &target).or_else(known).unwrap_or_else(|| fail(&format!("set CC_{target} and AR_{target} to the tools of the target")))
    };
    let (compiler, archiver) = (tool("CC", if prefix == Some("") { "cc" } else { "gcc" }), tool("AR", "ar"));
    let hosted = variable("CARGO_CFG_TARGET_OS") != "none";

    let core = PathBuf::from(variable("CARGO_MANIFEST_DIR")).join("core");
    let out = PathBuf::from(variable("OUT_DIR"));
    let mut flags: Vec<String> = compiler.split_whitespace().map(Into::into).collect();
    flags.extend(row.map_or(&[] as &[&str], |row| row.2).iter().map(ToString::to_string));
    flags.extend(["-std=c11", "-ffp-contract=off", "-ffunction-sections", "-c"].map(Into::into));
    flags.push(if ["s", "z"].contains(&variable("OPT_LEVEL").as_str()) { "-Os" } else { "-O2" }.into());
    flags.extend(hosted.then(|| "-fPIC".into()));
    flags.extend(float.then(|| "-DINS_REAL_FLOAT".into()));
    flags.extend(chosen("CFLAGS", &target).unwrap_or_default().split_whitespace().map(Into::into));

    let sources = sources(&core.join("src"));
    let share = sources.len().div_ceil(variable("NUM_JOBS").parse().unwrap_or(1)).max(1);
    let compile = |files: &[PathBuf]| {
        let mut command = Command::new(&flags[0]);
        command.args(&flags[1..]).arg("-I").arg(core.join("include")).args(files).current_dir(&out);
        command
    };
    run(sources.chunks(share).map(compile).collect());

    let name = if float { "insf" } else { "ins" };
    let library = out.join(format!("lib{name}.a"));
    let _ = fs::remove_file(&library); // ar would keep members that are gone
    let objects = sources.iter().filter_map(|path| path.file_stem()).map(|stem| out.join(stem).with_extension("o"));
    let mut archive = Command::new(&archiver);
    archive.arg("crs").arg(&library).args(objects);
    run(vec![archive]);

    println!("cargo::rerun-if-changed={}", core.display());
    println!("cargo::rustc-link-search=native={}", out.display());
    println!("cargo::rustc-link-lib=static={name}");
    if hosted {
        println!("cargo::rustc-link-lib=m");
    }
    println!("cargo::metadata=include={}", core.join("include").display());
}
