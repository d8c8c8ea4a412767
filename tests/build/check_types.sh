#!/usr/bin/env bash
# check_types.sh ROOT: has every type of the program a name of its own? Two types of one qualified name in two files are one
# type to the linker, which keeps the functions of either for both and says nothing. Prints each such name with its places,
# exits 1 if any.
# Types of unnamed namespaces belong to their files, and may repeat each other's names, but not the name of a type of the
# namespace around them: which of both is meant would depend on the headers that a file includes.
# Headers that are compiled once per instruction set define everything in an unnamed namespace: of a function or class of the whole
# program the linker would keep the copy for any of the sets.
set -u
cd "$1" || exit 2
# Sorted, so that messages come in one order on every machine.
mapfile -t files < <(find app core cpu cuda mpi python ui -type f \
    \( -name '*.h' -o -name '*.cpp' -o -name '*.cu' -o -name '*.cuh' -o -name '*.inc' \) 2>/dev/null | LC_ALL=C sort)
((${#files[@]} > 0)) || { echo "no sources in $1"; exit 2; }
awk '
# The text without comments, preprocessor lines and the content of literals; lines stay where they are.
function bare(text,    out, at, rest, end, delimiter) {
    out = ""
    while (match(text, /\/\/|\/\*|R"|"|[^0-9A-Za-z_"]'\''|\n[ \t]*#/)) {
        at = RSTART
        rest = substr(text, at + RLENGTH)
        end = substr(text, at, RLENGTH)
        out = out substr(text, 1, at - 1)
        if (end == "//") {
            sub(/^[^\n]*/, "", rest)
        } else if (end == "/*") {
            at = index(rest, "*/")
            out = out lines_in(substr(rest, 1, at + 1))
            rest = substr(rest, at + 2)
        } else if (end == "R\"") {
            delimiter = ")" substr(rest, 1, index(rest, "(") - 1) "\""
            at = index(rest, delimiter)
            out = out "0" lines_in(substr(rest, 1, at))
            rest = substr(rest, at + length(delimiter))
        } else if (end == "\"") {
            out = out "0"
            match(rest, /^([^"\\\n]|\\.)*"/)
            rest = substr(rest, RLENGTH + 1)
        } else if (end ~ /'\''$/) {
            out = out substr(end, 1, 1) "0"
            match(rest, /^([^'\''\\]|\\.)[^'\'']*'\''/)
            rest = substr(rest, RLENGTH + 1)
        } else {
            out = out "\n"
            while (match(rest, /^[^\n]*\\\n/)) {
                out = out "\n"
                rest = substr(rest, RLENGTH + 1)
            }
            sub(/^[^\n]*/, "", rest)
        }
        text = rest
    }
    return out text
}
function lines_in(text) { gsub(/[^\n]/, "", text); return text }

# "pl::Name" of the type that a head such as "template <class T> struct alignas(8) Name : Base" defines; "" if it defines none.
function type_of(head,    depth, round, i, c, name) {
    gsub(/\[\[[^]]*\]\]/, " ", head)
    gsub(/alignas *\([^()]*(\([^()]*\)[^()]*)*\)/, " ", head)
    # Template parameters and arguments hold keywords, too.
    name = ""
    depth = 0
    round = 0
    for (i = 1; i <= length(head); i++) {
        c = substr(head, i, 1)
        if (c == "(") round++
        if (c == ")") round--
        if (c == "<" && round == 0) { depth++; name = name "<" }
        else if (c == ">" && round == 0) depth--
        else if (depth == 0) name = name c
    }
    head = name
    gsub(/template *</, " ", head)
    gsub(/[ \t\n]+/, " ", head)
    if (head ~ /[(=]/ && head !~ /^[^(=]*(struct|class|union) [A-Za-z_0-9]+ (final )?:/) return ""
    if (!match(head, /(^| )(struct|class|union|enum|enum class|enum struct) [A-Za-z_][A-Za-z_0-9:]*( final)? ?(:|$|<)/)) return ""
    name = substr(head, RSTART, RLENGTH)
    if (name ~ /<$/) return ""  # a specialization has the name of its template
    sub(/^ /, "", name)
    sub(/ ?:$/, "", name)
    sub(/ ?final ?$/, "", name)
    sub(/ $/, "", name)
    sub(/^.* /, "", name)
    return name ~ /::/ ? "" : name  # a member of another type, defined outside of it
}

function read_file(file, text,    is_lanes, depth, head, line, token, at, hidden, path, name, kind, i, parts, n, closed) {
    is_lanes = text ~ /Included by one file per instruction set/
    text = bare("\n" text)
    depth = 0; head = ""; line = 0; closed = 0
    path[0] = ""; hidden[0] = 0
    while (match(text, /[{};\n]/)) {
        at = RSTART
        token = substr(text, at, 1)
        if (closed == 0) head = head substr(text, 1, at - 1)
        text = substr(text, at + 1)
        if (token == "\n") { line++; head = head " "; continue }
        if (closed > 0) {  # inside of something that is no namespace
            if (token == "{") closed++
            if (token == "}" && --closed == 0) head = ""
            continue
        }
        if (token == ";") { head = ""; continue }
        if (token == "}") {
            if (depth == 0) { printf "%s:%d: a bracket closes that was not opened\n", file, line; broken = 1; return }
            depth--; head = ""; continue
        }
        gsub(/^[ \t]+|[ \t]+$/, "", head)
        if (head ~ /^(inline )?namespace( |$)/ || head ~ /^extern 0$/) {
            name = head
            sub(/^(inline )?namespace ?/, "", name); sub(/^extern 0$/, "", name); gsub(/ /, "", name)
            depth++
            path[depth] = path[depth - 1] (name == "" ? "" : name "::")
            hidden[depth] = hidden[depth - 1] || (head ~ /^namespace$/)
            head = ""
            continue
        }
        if (is_lanes && !hidden[depth]) {
            printf "%s:%d: expected an unnamed namespace around what is compiled per instruction set\n", file, line
            broken = 1
        }
        name = type_of(head)
        if (name != "") note(path[depth] name, file ":" line, hidden[depth])
        closed = 1; head = ""
    }
    if (depth != 0 || closed != 0) { printf "%s: a bracket is not closed\n", file; broken = 1 }
}

function note(name, where, is_hidden) {
    if (is_hidden) {
        own[name] = own[name] (own[name] == "" ? "" : ", ") where
    } else {
        places[name] = places[name] (places[name] == "" ? "" : ", ") where
        if (++count[name] == 1) order[++names] = name
    }
}

FNR == 1 && NR > 1 { read_file(previous, text); text = "" }
{ text = text $0 "\n"; previous = FILENAME }
END {
    read_file(previous, text)
    breaches = 0
    for (i = 1; i <= names; i++) {
        name = order[i]
        if (count[name] < 2 && own[name] == "") continue
        printf "%s: expected one type of this name, got several: %s%s\n", name, places[name], own[name] == "" ? "" : ", " own[name]
        breaches++
    }
    if (breaches > 0) printf "%d breaches\n", breaches
    exit breaches > 0 || broken
}' "${files[@]}"
