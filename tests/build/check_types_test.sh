#!/usr/bin/env bash
# check_types_test.sh CHECKER: seeds one pair of types at a time into a small tree, and demands that each pair of one name is
# found, and no other.
set -u
checker=$1
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

fail() {
    printf 'FAILED: %s\n' "$*"
    failures=$((failures + 1))
}

# reset TEXT: a tree whose core/b.h has this text. core/a.h has one of each kind of type.
reset() {
    rm -rf "${tree:?}"/*
    mkdir -p "$tree/core"
    cat >"$tree/core/a.h" <<'END'
#pragma once
// struct Comment { };
namespace pl {
struct Plain { int braces = 0; };
class alignas(8) Aligned final : public Plain { struct Inner {}; };
enum class Choice : unsigned { A, B };
template <class T, int kCount = (3 > 2 ? 1 : 2)>
struct Template {
    T values[kCount];
};
union Either { int a; float b; };
namespace deep::er {
struct Far {};
}
const char* const kText = R"x(struct Raw { )" )x";
const char kQuote = '"', kBrace = '{';
}  // namespace pl
END
    printf '%b' "$1" >"$tree/core/b.h"
}

# expect_found NAME TEXT
expect_found() {
    reset "$2"
    local output
    if output=$(bash "$checker" "$tree"); then
        fail "not found: $2"
    elif [[ $output != "$1: expected one type of this name, got several: core/a.h:"*", core/b.h:"*"1 breaches" ]]; then
        fail "$2: expected one breach of $1, got: $output"
    fi
}

expect_none() {
    reset "$1"
    local output
    output=$(bash "$checker" "$tree") || fail "$1: expected no breach, got: $output"
}

expect_found pl::Plain 'namespace pl {\nstruct Plain {};\n}\n'
expect_found pl::Plain 'namespace pl\n{\nclass Plain\n{\n};\n}\n'
expect_found pl::Plain 'namespace pl {\n#if 1\nstruct [[nodiscard]] Plain {\n};\n#endif\n}\n'
expect_found pl::Plain 'namespace pl {\nvoid f() {}\nint g(struct Plain*);\nenum Plain { };\n}\n'
expect_found pl::Plain "namespace pl {\nconst char c = '\"';\nstruct Plain {};\nconst char d = '\"';\n}\n"
expect_found pl::Aligned 'namespace pl {\nstruct Aligned : Plain { int x; };\n}\n'
expect_found pl::Choice 'namespace pl { enum class Choice { A }; }\n'
expect_found pl::Template 'namespace pl {\ntemplate <class T>\nclass Template {};\n}\n'
expect_found pl::Either 'namespace pl { struct Either {}; }\n'
expect_found pl::deep::er::Far 'namespace pl { inline namespace deep {\nnamespace er { struct Far {}; } } }\n'
# A type of a file may not have the name of one around it.
expect_found pl::Plain 'namespace pl {\nnamespace {\nstruct Plain {};\n}\n}\n'

expect_none ''
expect_none 'namespace pl {\nstruct Plain;\nextern template struct Template<int>;\n}\n'
expect_none 'namespace pl {\ntemplate <>\nstruct Template<int> { int one; };\n}\n'
expect_none 'namespace pl {\nstruct Inner {};\nstruct Far {};\nstruct Raw {};\nstruct Comment {};\n}\n'
expect_none 'namespace pl::test {\nstruct Plain {};\n}\n'
expect_none 'namespace pl {\ninline Plain make() { struct Aligned { int x; }; return Plain{}; }\nconst Plain kPlain{};\n}\n'
expect_none 'namespace pl {\nnamespace {\nstruct Own {};\n}\n}\nnamespace pl::more {\nnamespace {\nstruct Own {};\n}\n}\n'
expect_none '/* struct Plain {\n}; */ namespace pl { int a = 1'\''000; // {\n}\n'

# What is compiled per instruction set is in an unnamed namespace.
lanes='// Included by one file per instruction set.\nnamespace pl {\n'
for text in 'template <>\nstruct Template<int> {};\n}\n' 'inline int width() { return 8; }\n}\n' 'namespace {\nint a;\n}\nstruct Wide {};\n}\n'; do
    reset "$lanes$text"
    output=$(bash "$checker" "$tree") && fail "not found: $lanes$text"
    [[ $output == "core/b.h:"*": expected an unnamed namespace around what is compiled per instruction set" ]] ||
        fail "no word of the unnamed namespace in: $output"
done
expect_none "${lanes}namespace {\\nstruct Wide {};\\ninline int width() { return 8; }\\n}\\n}\\n"

reset 'namespace pl {\n'
output=$(bash "$checker" "$tree") && fail 'a bracket that is not closed was not told'
[[ $output == *'core/b.h: a bracket is not closed'* ]] || fail "no word of the bracket in: $output"
output=$(bash "$checker" "$tree/core" 2>&1) && fail 'a folder without sources was accepted'

((failures == 0))
