//! What `build.rs` refuses, and how it says so.

#[cfg(not(feature = "bundled-glslang"))]
#[allow(dead_code)]
#[path = "../build/compile.rs"]
mod compile;
#[allow(dead_code)]
#[path = "../build/docs.rs"]
mod docs;
#[allow(dead_code)]
#[path = "../build/function.rs"]
mod function;
#[allow(dead_code)]
#[path = "../build/include.rs"]
mod include;
#[allow(dead_code)]
#[path = "../build/interface.rs"]
mod interface;
#[allow(dead_code)]
#[path = "../build/key.rs"]
mod key;
#[allow(dead_code)]
#[path = "../build/layout.rs"]
mod layout;
#[allow(dead_code)]
#[path = "../build/pack.rs"]
mod pack;
#[allow(dead_code)]
#[path = "../build/parallel.rs"]
mod parallel;
#[allow(dead_code)]
#[path = "../build/permutation.rs"]
mod permutation;
#[path = "../build/spirv.rs"]
mod spirv;

use interface::{Binding, BindingKind, Field, FieldType, Interface, Slot, Struct};
use permutation::{List, Permutation};
use std::path::Path;

/// The list with that line and what it defines.
fn list(line: &str) -> List {
    let defines = line.split_whitespace().skip(1).map(|word| word.trim_matches(['[', ']']));
    let defines: String = defines.map(|name| format!("define {name} Something.\n")).collect();
    permutation::parse(&format!("{defines}{line}\n")).unwrap()
}

fn one(line: &str) -> Permutation {
    list(line).permutations.remove(0)
}

#[test]
fn a_permutation_has_one_name_in_the_list_and_one_in_rust() {
    let text = "define UV Streams. # one\ndefine COLOR A colour.\n# fur\n\nfur.frag UV [COLOR] # two\nfur.vert\n";
    let list = permutation::parse(text).unwrap();
    let names: Vec<_> = list.permutations.iter().map(Permutation::name).collect();
    assert_eq!(names, ["fur.frag+UV", "fur.frag+UV+COLOR", "fur.vert"]);
    assert_eq!((list.permutations[0].stem(), list.permutations[2].line), ("fur", 6));
    let keys = key::Keys::new(&list).unwrap();
    let literal = "super::ShaderKey::new(super::ShaderFile::FurFrag, super::Defines(0x3))";
    assert_eq!(keys.literal(&list.permutations[1]), literal);
    let generated = keys.generate();
    let bit = "    /// A colour.\n    pub const COLOR: Self = Self(1 << 1);\n";
    assert!(generated.contains(bit) && generated.contains("Self::FurVert => \"fur.vert\""), "{generated}");
}

#[test]
fn bad_lines_are_all_reported_with_their_number() {
    let text = "define UV Streams.\ndefine COLOR A colour.\ndefine 3D Depth.\ndefine MAPS\na.frag\na.geom\n\
                a.frag MAPS\na.frag COLOR UV\na.frag\n3d.frag\n";
    assert_eq!(
        permutation::parse(text).unwrap_err(),
        [
            "shaders_glsl/permutations:3: `3D` is not the name of a define",
            "shaders_glsl/permutations:4: say what of an interface `MAPS` changes",
            "shaders_glsl/permutations:6: `a.geom` must end in .vert, .frag or .comp",
            "shaders_glsl/permutations:7: `MAPS` has no define line above",
            "shaders_glsl/permutations:8: `a.frag+COLOR+UV` has its defines in another order than their own lines",
            "shaders_glsl/permutations:9: `a.frag` is in line 5, too",
            "shaders_glsl/permutations:10: `3d.frag` must start with a letter",
        ]
    );
    let many: String = (0..65).map(|define| format!("define D{define} Something.\n")).collect();
    let error = key::Keys::new(&permutation::parse(&many).unwrap()).unwrap_err();
    assert_eq!(error, "shaders_glsl/permutations: 65 defines, of which only 64 fit");
}

#[test]
fn modules_of_a_file_share_packs_that_are_no_larger_than_they_may_be() {
    let (small, large) = (vec![1, 2, 3], vec![4; 250_000]);
    let modules = [("a", &small), ("a", &large), ("a", &large), ("b", &small), ("b", &small)];
    let packs = pack::Packs::new(modules.into_iter().map(|(group, words)| (group, &words[..])));
    let places: Vec<_> = packs.places.iter().map(|place| (place.pack, place.first_word, place.word_count)).collect();
    assert_eq!(places, [(0, 0, 3), (0, 3, 250_000), (1, 0, 250_000), (2, 0, 3), (2, 3, 3)]);
    assert_eq!(packs.packs[2], [1, 2, 3, 1, 2, 3]);
}

/// A `shaders_glsl` folder with these files.
fn tree(files: &[(&str, &str)]) -> tempfile::TempDir {
    let root = tempfile::tempdir().unwrap();
    for (path, text) in files {
        let path = root.path().join(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    root
}

/// Messages without the temporary folder's path.
fn relative(message: &str, root: &Path) -> String {
    message.replace(&format!("{}/", root.display()), "")
}

#[test]
fn includes_and_defines_expand_with_their_lines() {
    let root = tree(&[
        ("pass/a.frag", "// doc\n#version 460\n#include \"b.glsl\"\nvoid main() {}\n"),
        ("lib/b.glsl", "float b;\n"),
    ]);
    let text = include::expand(&one("a.frag UV N"), &root.path().join("pass"), root.path()).unwrap();
    assert_eq!(
        relative(&text, root.path()),
        "// doc\n#version 460\n#extension GL_GOOGLE_cpp_style_line_directive : require\n#define UV 1\n#define N 1\n\
         #line 3 \"pass/a.frag\"\n#line 1 \"lib/b.glsl\"\nfloat b;\n#line 4 \"pass/a.frag\"\nvoid main() {}\n"
    );
}

#[test]
fn bad_includes_name_their_line() {
    let root = tree(&[
        ("pass/none.frag", "#version 460\n\n#include \"none.glsl\"\n"),
        ("pass/up.frag", "#version 460\n#include \"../pass/none.frag\"\n"),
        ("pass/cycle.frag", "#version 460\n#include \"c.glsl\"\n"),
        ("host/c.glsl", "\n#include \"c.glsl\"\n"),
        ("pass/both.frag", "#version 460\n#include \"d.glsl\"\n"),
        ("host/d.glsl", ""),
        ("lib/d.glsl", ""),
        ("pass/bare.frag", "void main() {}\n"),
    ]);
    let folder = root.path().join("pass");
    let error = |file: &str| relative(&include::expand(&one(file), &folder, root.path()).unwrap_err(), root.path());
    assert_eq!(
        error("none.frag"),
        "pass/none.frag:3: `none.glsl` is in neither shaders_glsl/lib nor shaders_glsl/host nor shaders_glsl/pass"
    );
    assert_eq!(
        error("both.frag"),
        "pass/both.frag:2: `d.glsl` is in both shaders_glsl/lib and shaders_glsl/host: rename one"
    );
    assert_eq!(error("up.frag"), "pass/up.frag:2: write #include \"file.glsl\"");
    assert_eq!(error("cycle.frag"), "host/c.glsl:2: `c.glsl` includes itself");
    assert_eq!(error("bare.frag"), "pass/bare.frag:1: must start with #version 460");
    assert!(error("missing.frag").starts_with("pass/missing.frag: "));
}

#[cfg(not(feature = "bundled-glslang"))]
#[test]
fn a_shader_error_names_the_file_and_line_of_the_glsl() {
    let root = tree(&[
        ("pass/a.frag", "#version 460\n#include \"b.glsl\"\nvoid main() {\n    missing = 1;\n}\n"),
        ("pass/c.frag", "#version 460\n#ifdef UV\n#include \"d.glsl\"\n#endif\nvoid main() {}\n"),
        ("lib/b.glsl", "\nfloat b() { return 1.0; }\n"),
        ("lib/d.glsl", "\nfloat d() { return e; }\n"),
    ]);
    let compiler = compile::Compiler::find().unwrap();
    let compile = |line: &str| {
        let glsl = include::expand(&one(line), &root.path().join("pass"), root.path());
        let spirv = glsl.and_then(|glsl| compiler.compile(&one(line), &glsl, root.path()));
        spirv.map(|words| words[0]).map_err(|error| relative(&error, root.path()))
    };
    assert_eq!(compile("a.frag"), Err("pass/a.frag:4: 'missing' : undeclared identifier".to_owned()));
    assert_eq!(compile("c.frag UV"), Err("lib/d.glsl:2: 'e' : undeclared identifier".to_owned()));
    assert_eq!(compile("c.frag"), Ok(0x0723_0203));
}

/// naga reads neither; the shader that the device gets keeps both.
#[cfg(not(feature = "bundled-glslang"))]
#[test]
fn reflection_does_without_constant_operations_and_sample_masks() {
    let text = "#version 460\nlayout(constant_id = 2) const int LAYERS = 3;\nlayout(location = 0) out vec4 color;\n\
                void main() {\n    color = vec4(LAYERS > 1 ? 1.0 : 0.0);\n    gl_SampleMask[0] = gl_SampleMaskIn[0];\n}\n";
    let root = tree(&[("pass/a.frag", text)]);
    let compiler = compile::Compiler::find().unwrap();
    let glsl = include::expand(&one("a.frag"), &root.path().join("pass"), root.path()).unwrap();
    let words = compiler.compile(&one("a.frag"), &glsl, root.path()).unwrap();
    let simple = spirv::for_reflection(&words);
    assert_eq!(simple[..5], words[..5]);
    let count = |words: &[u32], is_wanted: fn(&[u32]) -> bool| {
        spirv::instructions(words).filter(|instruction| is_wanted(instruction)).count()
    };
    let is_constant_operation = |words: &[u32]| words[0] & 0xffff == 52;
    assert!(count(&words, is_constant_operation) > 0);
    assert_eq!(count(&simple, is_constant_operation), 0);
    // Storage classes: 1 input, 3 output, 6 private.
    let variables = |words: &[u32], class: u32| {
        spirv::instructions(words).filter(|words| words[0] & 0xffff == 59 && words[3] == class).count()
    };
    assert_eq!([1, 3, 6].map(|class| variables(&words, class)), [1, 2, 0]);
    assert_eq!([1, 3, 6].map(|class| variables(&simple, class)), [0, 1, 2]);
}

#[cfg(not(feature = "bundled-glslang"))]
#[test]
fn what_the_program_carries_has_no_names() {
    let text = "#version 460\nlayout(location = 0) out vec4 color;\nvoid main() {\n    color = vec4(1.0);\n}\n";
    let root = tree(&[("pass/a.frag", text)]);
    let compiler = compile::Compiler::find().unwrap();
    let glsl = include::expand(&one("a.frag"), &root.path().join("pass"), root.path()).unwrap();
    let words = compiler.compile(&one("a.frag"), &glsl, root.path()).unwrap();
    let stripped = spirv::stripped(&words);
    assert_eq!(stripped[..5], words[..5]);
    let opcodes = |words: &[u32]| spirv::instructions(words).map(|words| words[0] & 0xffff).collect::<Vec<_>>();
    // OpSource, OpSourceExtension and OpName.
    let kept = opcodes(&words).into_iter().filter(|opcode| ![3, 4, 5].contains(opcode)).collect::<Vec<_>>();
    assert!(opcodes(&words).contains(&5));
    assert_eq!(opcodes(&stripped), kept);
}

fn interface() -> Interface {
    Interface::default()
}

fn binding(name: &str, kind: BindingKind) -> Interface {
    Interface { bindings: vec![Binding { set: 1, binding: 2, name: name.to_owned(), kind }], ..interface() }
}

#[test]
fn stages_of_one_pass_share_their_descriptors() {
    let (vertex, fragment, compute) = (one("a.vert"), one("a.frag UV"), one("a.comp"));
    let check = |stage: &Permutation, other: Interface| {
        let first = binding("base", BindingKind::Storage { readonly: true });
        interface::check([(&vertex, &first), (stage, &other)].into_iter())
    };
    assert_eq!(check(&fragment, binding("base", BindingKind::Storage { readonly: false })), Ok(()));
    assert_eq!(check(&compute, binding("other", BindingKind::Texture)), Ok(()));
    assert!(check(&fragment, binding("base", BindingKind::Texture)).is_err());
    assert_eq!(
        check(&fragment, binding("other", BindingKind::Storage { readonly: true })).unwrap_err(),
        ["set 1 binding 2 is Storage { readonly: true } `base` in a.vert but Storage { readonly: true } `other` in \
          a.frag+UV: stages of one pass share their layout"]
    );
}

#[test]
fn a_fragment_shader_reads_what_its_vertex_shader_writes() {
    let slot =
        |location, glsl_type: &str| vec![Slot { location, name: "uv".to_owned(), glsl_type: glsl_type.to_owned() }];
    let vertex = Interface { outputs: slot(0, "vec2"), ..interface() };
    let check = |inputs: Vec<Slot>| {
        let fragment = Interface { inputs, ..interface() };
        interface::check([(&one("a.vert UV"), &vertex), (&one("a.frag UV"), &fragment)].into_iter())
    };
    assert_eq!(check(slot(0, "vec2")), Ok(()));
    assert_eq!(
        check(slot(1, "vec2")).unwrap_err(),
        ["a.frag+UV: reads vec2 `uv` at location 1, which a.vert+UV does not write"]
    );
    assert_eq!(
        check(slot(0, "vec3")).unwrap_err(),
        ["a.frag+UV: reads vec3 `uv` at location 0, where a.vert+UV writes vec2"]
    );
}

#[test]
fn a_define_that_merely_switches_code_is_refused() {
    let (plain, switched, bound) = (one("a.frag"), one("a.frag FAST"), one("a.frag UV"));
    let map = binding("base", BindingKind::Texture);
    assert_eq!(interface::check([(&plain, &interface()), (&bound, &map)].into_iter()), Ok(()));
    assert_eq!(
        interface::check([(&plain, &map), (&switched, &map)].into_iter()).unwrap_err(),
        ["a.frag+FAST: `FAST` changes nothing of the interface of a.frag: make it a specialization constant"]
    );
}

fn light(bytes: u32, is_element: bool) -> Struct {
    let numbers = |count| FieldType::Numbers { scalar: "f32", count };
    let fields = vec![
        Field { name: "color".to_owned(), offset: 0, ty: numbers(3) },
        Field { name: "cone".to_owned(), offset: 16, ty: numbers(2) },
    ];
    Struct { name: "Light".to_owned(), bytes, is_element, fields }
}

#[test]
fn a_struct_becomes_rust_with_padding_and_asserts() {
    let mut comments = docs::Comments::default();
    comments.add("// Shines.\nstruct Light {\n    vec3 color; // Radiance.\n    vec2 cone;\n};\n");
    let structs = [("a".to_owned(), light(24, false)), ("b".to_owned(), light(32, true))];
    let text = layout::generate(structs.into_iter(), &comments).unwrap();
    let body = "/// Shines.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Light {
    /// Radiance.
    pub r#color: [f32; 3],
    #[doc(hidden)]
    pub _padding_0: [u32; 1],
    /// GLSL `cone`.
    pub r#cone: [f32; 2],
    #[doc(hidden)]
    pub _padding_1: [u32; 2],
}
const _: () = {
    assert!(core::mem::offset_of!(Light, r#color) == 0);
    assert!(core::mem::offset_of!(Light, r#cone) == 16);
    assert!(core::mem::size_of::<Light>() == 32);
};
";
    assert!(text.starts_with(body), "{text}");
}

#[test]
fn one_name_has_one_layout() {
    let mut other = light(32, true);
    other.fields[1].offset = 12;
    for other in [other, light(48, true)] {
        let structs = [("a.frag".to_owned(), light(32, true)), ("b.frag".to_owned(), other)];
        let errors = layout::generate(structs.into_iter(), &docs::Comments::default()).unwrap_err();
        assert_eq!(errors, ["struct `Light` has another layout in a.frag than in b.frag"]);
    }
}

#[test]
fn an_array_that_rust_cannot_mirror_is_refused() {
    let element = Box::new(FieldType::Numbers { scalar: "f32", count: 1 });
    let weights = FieldType::Array { element, length: 4, stride: 16 };
    let fields = vec![Field { name: "weights".to_owned(), offset: 0, ty: weights }];
    let block = Struct { name: "Draw".to_owned(), bytes: 64, is_element: false, fields };
    let errors = layout::generate([("a.frag".to_owned(), block)].into_iter(), &docs::Comments::default()).unwrap_err();
    assert_eq!(
        errors,
        [
            "struct `Draw` in a.frag: `weights`: array elements of 4 bytes lie 16 apart; use vec4 elements, or std430 or \
          scalar layout"
        ]
    );
}

#[test]
fn functions_of_the_library_are_found_with_their_flattened_types() {
    let mut library = function::Library::default();
    let text = "// Doc.\n#ifndef A\nconst float X = 1.0;\nstruct Lamp {\n    vec3 color; // lux\n    uint kind;\n    float \
                _reserved_0;\n};\nfloat lit(Lamp lamp, vec3 place,\n          bool is_near) {\n    return X;\n}\n#endif\n";
    library.add("lamp.glsl", text, true).unwrap();
    let [lit] = library.functions.as_slice() else { panic!("{:?}", library.functions) };
    assert_eq!((lit.name.as_str(), lit.file.as_str(), lit.result.as_str()), ("lit", "lamp.glsl", "float"));
    let values: Vec<_> = lit
        .parameters
        .iter()
        .flat_map(|parameter| library.flatten(&parameter.ty, &parameter.name).unwrap())
        .map(|value| (value.path, value.scalar, value.words))
        .collect();
    let expected =
        [("lamp.color", "Float", 3), ("lamp.kind", "Uint", 1), ("place", "Float", 3), ("is_near", "Bool", 1)];
    assert_eq!(values, expected.map(|(path, scalar, words)| (path.to_owned(), scalar, words)));
    let mut error = |text: &str| library.add("b.glsl", text, true).unwrap_err();
    assert_eq!(error("\nfloat f(inout vec3 x) {\n}\n"), "2: `inout vec3 x` is not a type and a name");
    assert!(error("float lit(float x) {\n}\n").starts_with("1: `lit` is defined twice"));
    assert!(error("precision highp float;\n").starts_with("1: `precision highp float;` is no definition"));
    assert!(library.flatten("sampler2D", "map").is_err());
}
