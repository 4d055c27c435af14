"""The Rust crates: declarations as in the headers, cargo's own tests, neither std nor an allocator needed."""

import os
import re
import shutil
import subprocess
import tarfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
RUST = ROOT / "bindings" / "rust"
CORE = ROOT / "libins" / "core"
TARGET = ROOT / "build" / "rust"  # of cargo; shared by all tests here
TYPES = {"double": [], "float": ["--no-default-features", "--features", "float"]}
DEFINES = {"double": [], "float": ["-DINS_REAL_FLOAT"]}
C_NAMES = {
    "u16": "uint16_t",
    "u32": "uint32_t",
    "i16": "int16_t",
    "i32": "int32_t",
    "i64": "int64_t",
    "usize": "size_t",
}
C_NAMES |= {"c_int": "int", "c_uint": "unsigned", "c_long": "long", "c_char": "char"}


def run(command: list[str], **options: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, capture_output=True, text=True, check=False, **options)  # type: ignore[call-overload,no-any-return]


def cargo(*arguments: str, **variables: str) -> subprocess.CompletedProcess[str]:
    assert shutil.which("cargo"), "cargo is missing: apt-get install cargo-web rustc-web, or rustup"
    environment = os.environ | {"CARGO_TARGET_DIR": str(TARGET), "CARGO_TERM_COLOR": "never", "RUSTFLAGS": "-Dwarnings"}
    return run(["cargo", *arguments], cwd=RUST, env=environment | variables)


def passed(done: subprocess.CompletedProcess[str]) -> str:
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def c_declaration(rust: str, name: str) -> str:
    """A Rust type in C, around the name of what has it."""
    rust = rust.strip()
    if array := re.fullmatch(r"\[(.+); (\d+)usize\]", rust):
        return c_declaration(array[1], f"{name}[{array[2]}]")
    if pointer := re.fullmatch(r"\*(mut|const) (.+)", rust):
        return ("const " if pointer[1] == "const" else "") + c_declaration(pointer[2], f"*{name}")
    rust = rust.removeprefix("::core::ffi::")
    return f"{C_NAMES.get(rust, rust)} {name}"


def bindings() -> str:
    text = (RUST / "libins-sys/src/bindings.rs").read_text(encoding="utf-8")
    return re.sub(r"\s*#\[doc = .*", "", text)


def functions(text: str) -> dict[str, str]:
    """C declarations by name."""
    found = {}
    for name, parameters, result in re.findall(r"pub fn (ins_\w+)\(([^)]*)\)\s*(?:->\s*([^;]+))?;", text):
        types = [p.split(":", 1)[1] for p in re.split(r",\s*", parameters.strip().rstrip(",")) if p]
        arguments = ", ".join(c_declaration(t, "") for t in types) or "void"
        found[name] = c_declaration(result or "void", f"{name}({arguments})") + ";"
    return found


def program(text: str, constants: str) -> str:
    """A C program that compiles only if types and functions are the headers', and names the constants that are not."""
    lines = ['#include "ins/ins.h"', "#include <stdio.h>", *functions(text).values()]
    for name, body in re.findall(r"pub struct (ins_\w+) \{(.*?)\n\}", text, re.DOTALL):
        fields = re.findall(r"pub (\w+): (.+),", body)
        lines.append(f"struct copy_{name} {{ {' '.join(c_declaration(t, f) + ';' for f, t in fields)} }};")
        lines.append(f'_Static_assert(sizeof(struct copy_{name}) == sizeof({name}), "{name}: size");')
        for field, kind in fields:
            same = f"_Generic(&(({name}*)0)->{field}, {c_declaration(kind, '(*)')}: 1, default: 0)"
            lines.append(f'_Static_assert({same}, "{name}.{field}: type");')
    for name, kind in re.findall(r"pub static (ins_\w+): (\w+);", text):
        lines.append(f"extern const {kind} {name};")
    lines += ["int main(void)", "{", "int wrong = 0;"]
    integers = re.findall(r"pub const (INS_\w+): \w+ = (-?\d+);", text)
    reals = re.findall(r"pub const (INS_\w+): (?:ins_real|i32) = (.+);", constants)
    for name, value in integers + reals:
        value = re.sub(r"(?<![\w.])\d[\w.]*(?:(?<=e)-\d+)?", lambda number: literal(number[0]), value)
        lines.append(f'if (!({name} == {value})) {{ wrong++; printf("{name}\\n"); }}')
    return "\n".join([*lines, "return wrong;", "}", ""])


def literal(number: str) -> str:
    number = number.replace("_", "")
    return f"INS_C({number})" if "." in number or "e" in number else number


def check(text: str, constants: str, kind: str, folder: Path) -> str:
    """What the C compiler and the program say against the declarations; nothing if they are right."""
    source, binary = folder / "declarations.c", folder / "declarations"
    source.write_text(program(text, constants), encoding="utf-8")
    flags = ["-std=c11", *DEFINES[kind], f"-I{CORE / 'include'}"]
    done = run(["cc", *flags, str(source), "-o", str(binary)])
    return done.stderr if done.returncode else run([str(binary)]).stdout


@pytest.mark.parametrize("kind", TYPES)
def test_declarations_are_those_of_the_headers(kind: str, tmp_path: Path) -> None:
    constants = (RUST / "libins-sys/src/lib.rs").read_text(encoding="utf-8")
    assert check(bindings(), constants, kind, tmp_path) == "", "run bindings/rust/generate"


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("pub prev: [[ins_real; 3usize]; 3usize],", "pub prev: [[ins_real; 3usize]; 2usize],"),
        ("pub count: uint_least8_t,\n", "\n"),
        ("pub fn ins_version() -> ::core::ffi::c_long", "pub fn ins_version() -> ::core::ffi::c_int"),
        ("pub const INS_GIMU_T2_LEN: u32 = 23;", "pub const INS_GIMU_T2_LEN: u32 = 22;"),
        ("pub const INS_GIMU_KP: ins_real = 0.2087;", "pub const INS_GIMU_KP: ins_real = 0.2088;"),
    ],
)
def test_a_declaration_that_differs_is_found(right: str, wrong: str, tmp_path: Path) -> None:
    constants = (RUST / "libins-sys/src/lib.rs").read_text(encoding="utf-8")
    assert right in bindings() + constants
    assert check(bindings().replace(right, wrong), constants.replace(right, wrong), "double", tmp_path) != ""


def test_everything_the_headers_offer_is_declared() -> None:
    headers = "".join(path.read_text(encoding="utf-8") for path in sorted((CORE / "include/ins").glob("*.h")))
    offered = set(re.findall(r"INS_API [\w ]+[ *](ins_\w+)\(", headers))
    assert len(offered) > 100
    assert offered - set(functions(bindings())) == set(), "run bindings/rust/generate"
    macros = set(re.findall(r"#define (INS_\w+) +[^\n]*(?:INS_C|INS_MARKOV_DEG_PER_HOUR|INT32_C)\b", headers))
    own = (RUST / "libins-sys/src/lib.rs").read_text(encoding="utf-8")
    assert macros - set(re.findall(r"pub const (INS_\w+)", own)) == set(), (
        "add them to bindings/rust/libins-sys/src/lib.rs"
    )


@pytest.mark.parametrize("kind", TYPES)
def test_cargo_test(kind: str) -> None:
    """Reference files, each module, examples and those in comments; a warning is an error."""
    output = passed(cargo("test", "--offline", "--locked", *TYPES[kind]))
    assert len(re.findall(r"^test .* ok$", output, re.MULTILINE)) > 30, output


@pytest.mark.parametrize("kind", TYPES)
def test_lints(kind: str) -> None:
    assert shutil.which("cargo-clippy") and shutil.which("cargo-fmt"), (
        "clippy or rustfmt is missing: apt-get install rust-web-clippy rustfmt-web, or rustup component add"
    )
    passed(cargo("clippy", "--offline", "--locked", "--all-targets", *TYPES[kind], "--", "-D", "warnings"))
    passed(cargo("fmt", "--check"))


@pytest.mark.parametrize("features", [["--features", "float"], ["--no-default-features"]])
def test_two_number_types_or_none_are_refused(features: list[str]) -> None:
    done = cargo("check", "--offline", "--locked", *features)
    assert done.returncode != 0
    assert "choose exactly one of the features `double` (default) and `float`" in done.stdout + done.stderr


def test_a_compiler_that_is_missing_is_named() -> None:
    done = cargo("check", "--offline", "--locked", "-p", "libins-sys", CC="no-such-compiler")
    assert done.returncode != 0
    assert re.search(r"no-such-compiler.*Set CC_<target> and AR_<target>", done.stdout + done.stderr)


def test_neither_std_nor_an_allocator(tmp_path: Path) -> None:
    """A no_std program is linked with libm and the C library's memcpy and start alone, and runs."""
    passed(cargo("build", "--offline", "--locked"))
    library = tmp_path / "libfirmware.a"
    debug = TARGET / "debug"
    compile_rust = ["rustc", "--edition", "2021", "--crate-type", "staticlib", "-C", "panic=abort", "-C", "opt-level=1"]
    uses = ["--extern", f"libins={debug / 'liblibins.rlib'}", "-L", f"dependency={debug / 'deps'}"]
    passed(run([*compile_rust, *uses, "-o", str(library), str(Path(__file__).with_name("firmware.rs"))]))
    main = tmp_path / "main.c"
    main.write_text("int fly(void);\nint main(void)\n{\n    return fly();\n}\n", encoding="utf-8")
    program = tmp_path / "firmware"
    link = ["cc", str(main), str(library), "-nodefaultlibs", "-Wl,--gc-sections", "-lm", "-lc", "-o", str(program)]
    passed(run(link))
    assert run([str(program)]).returncode == 0
    needed = {line.split()[-1].split("@")[0] for line in passed(run(["nm", "-u", str(program)])).splitlines()}
    system = {
        "__libc_start_main",
        "_ITM_deregisterTMCloneTable",
        "_ITM_registerTMCloneTable",
        "__cxa_finalize",
        "__gmon_start__",
    }
    assert needed - system <= {"memcpy", "memmove", "memset", "memcmp", "sqrt", "sin", "cos", "sincos", "atan2"}


def test_the_package_holds_the_core() -> None:
    """What would be published: the core's files are in it, not a link to them."""
    passed(cargo("package", "--offline", "--no-verify", "--allow-dirty", "-p", "libins-sys"))
    archive = next((TARGET / "package").glob("libins-sys-*.crate"))
    with tarfile.open(archive) as package:
        held = {member.name.split("/", 1)[1]: member for member in package.getmembers()}
        for path in sorted([*CORE.glob("src/*.[ch]"), *CORE.glob("include/ins/*.h")]):
            member = held[f"core/{path.relative_to(CORE)}"]
            stream = package.extractfile(member)
            assert member.isreg() and stream is not None
            assert stream.read() == path.read_bytes()
    assert {"build.rs", "LICENSE", "src/lib.rs", "src/bindings.rs"} <= set(held)


def test_the_example_of_the_page_is_the_one_compiled() -> None:
    page = (ROOT / "docs/rust.md").read_text(encoding="utf-8")
    example = (RUST / "libins/examples/navigate.rs").read_text(encoding="utf-8")
    assert f"```rust\n{example}```" in page
    assert passed(cargo("run", "--offline", "--locked", "-q", "--example", "navigate")).startswith("heading ")


def test_minimum_version_is_the_one_on_the_page() -> None:
    version = re.search(r'rust-version = "([\d.]+)"', (RUST / "Cargo.toml").read_text(encoding="utf-8"))
    assert version and f"Rust {version[1]}" in (ROOT / "docs/rust.md").read_text(encoding="utf-8")
