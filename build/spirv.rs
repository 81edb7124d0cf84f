//! Rewrites SPIR-V modules: one with the same interface that naga can read, which only reflection sees, and one without
//! what only people read, which the program carries.
//!
//! Numbers are those of the Khronos SPIR-V specification, sections 3.7, 3.20, 3.21 and 3.32.

/// Words before the first instruction.
const HEADER_WORDS: usize = 5;
/// OpSourceContinued, OpSource, OpSourceExtension, OpName, OpMemberName, OpString, OpLine, OpNoLine, OpModuleProcessed.
const DEBUG_OPCODES: [u32; 9] = [2, 3, 4, 5, 6, 7, 8, 317, 330];
const OP_TYPE_POINTER: u32 = 32;
const OP_CONSTANT_NULL: u32 = 46;
const OP_SPEC_CONSTANT_OP: u32 = 52;
const OP_VARIABLE: u32 = 59;
const OP_DECORATE: u32 = 71;
const OP_MEMBER_DECORATE: u32 = 72;
const DECORATION_BUILT_IN: u32 = 11;
const DECORATION_NON_READABLE: u32 = 25;
const BUILT_IN_SAMPLE_MASK: u32 = 20;
const STORAGE_PRIVATE: u32 = 6;

/// The module without what naga does not know:
/// - an operation on specialization constants (`if (LAYERS > 1)`) becomes zero of its type;
/// - the sample mask, an array that naga takes for a number, becomes a private variable;
/// - what a shader may only write it may read, too: whether it does is seen by its instructions.
pub(crate) fn for_reflection(spirv: &[u32]) -> Vec<u32> {
    let masks: Vec<u32> = instructions(spirv)
        .filter_map(|instruction| match *instruction {
            [op, target, DECORATION_BUILT_IN, BUILT_IN_SAMPLE_MASK] if opcode(op) == OP_DECORATE => Some(target),
            _ => None,
        })
        .collect();
    let mask_pointers: Vec<u32> = instructions(spirv)
        .filter_map(|instruction| match *instruction {
            [op, pointer, variable, ..] if opcode(op) == OP_VARIABLE && masks.contains(&variable) => Some(pointer),
            _ => None,
        })
        .collect();
    let mut words: Vec<u32> = spirv.iter().copied().take(HEADER_WORDS).collect();
    for instruction in instructions(spirv) {
        match *instruction {
            [op, ty, result, ..] if opcode(op) == OP_SPEC_CONSTANT_OP => {
                words.extend([3 << 16 | OP_CONSTANT_NULL, ty, result]);
            }
            [op, pointer, _, base] if opcode(op) == OP_TYPE_POINTER && mask_pointers.contains(&pointer) => {
                words.extend([op, pointer, STORAGE_PRIVATE, base]);
            }
            [op, pointer, variable, _] if opcode(op) == OP_VARIABLE && masks.contains(&variable) => {
                words.extend([op, pointer, variable, STORAGE_PRIVATE]);
            }
            [op, _, DECORATION_NON_READABLE] if opcode(op) == OP_DECORATE => {}
            [op, _, _, DECORATION_NON_READABLE] if opcode(op) == OP_MEMBER_DECORATE => {}
            _ => words.extend(instruction),
        }
    }
    words
}

/// The module without names, sources and lines: nothing in it depends on them.
pub(crate) fn stripped(spirv: &[u32]) -> Vec<u32> {
    let header = spirv.iter().take(HEADER_WORDS);
    let kept = instructions(spirv).filter(|instruction| !DEBUG_OPCODES.contains(&opcode(instruction[0])));
    header.chain(kept.flatten()).copied().collect()
}

/// The instructions of a module, each with its first word, whose upper half counts its words.
pub(crate) fn instructions(spirv: &[u32]) -> impl Iterator<Item = &[u32]> {
    let mut rest = spirv.get(HEADER_WORDS..).unwrap_or_default();
    std::iter::from_fn(move || {
        // The bounds keep a malformed count from looping or reading past the end.
        let count = ((*rest.first()? >> 16) as usize).clamp(1, rest.len());
        let (instruction, tail) = rest.split_at(count);
        rest = tail;
        Some(instruction)
    })
}

fn opcode(first_word: u32) -> u32 {
    first_word & 0xffff
}
