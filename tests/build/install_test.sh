#!/usr/bin/env bash
# install_test.sh ROOT BUILD VERSION: an installed program works where its folder has been moved to, and what is installed beside it tells
# of every option and library that the program has.
set -u
root=$(realpath "$1") build=$(realpath "$2") version=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset PATHLIGHT_ASSETS
failures=0
fail() {
    printf 'FAILED: %s\n' "$1"
    failures=$((failures + 1))
}

cmake --install "$build" --prefix "$work/first" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
mv "$work/first" "$work/moved"
installed="$work/moved" program="$work/moved/bin/pathlight"

# Scenes come from beside the program, not from the source: one of a name that the source lacks is found.
scenes="$installed/share/pathlight/assets/scenes"
mkdir "$scenes/moved"
for suffix in json obj mtl; do cp "$scenes/cornell/cornell.$suffix" "$scenes/moved/moved.$suffix"; done
sed -i 's/cornell\.obj/moved.obj/' "$scenes/moved/moved.json"
sed -i 's/cornell\.mtl/moved.mtl/' "$scenes/moved/moved.obj"
(cd "$work" && "$program" render moved --size 16x16 --spp 1 -q -o moved.png) || fail 'a scene of the moved folder does not render'
[[ -s $work/moved.png ]] || fail 'there is no picture'
rm -r "$scenes/door"
if (cd "$work" && "$program" info door) >/dev/null 2>&1; then fail 'a scene that was not installed is found elsewhere'; fi

for file in share/doc/pathlight/LICENSE share/doc/pathlight/THIRD-PARTY.md share/doc/pathlight/CHANGELOG.md; do
    cmp "$installed/$file" "$root/${file##*/}" || fail "$file"
done
"$program" --licenses >"$work/licenses"
# Whole lines, so that the order of the parts is free.
for file in LICENSE THIRD-PARTY.md; do
    [[ $(grep -cvxFf "$work/licenses" "$root/$file") == 0 ]] || fail "--licenses does not hold all of $file"
done
[[ $(objdump -p "$program" | sed -n 's/^ *NEEDED *\(lib[^-.]*\).*/\1/p' | sort -u | tee "$work/libraries" | wc -l) -gt 3 ]] ||
    fail 'the libraries of the program are unknown'
while read -r library; do
    grep -qF "\`$library\`" "$root/THIRD-PARTY.md" || fail "THIRD-PARTY.md does not name $library, which the program needs"
done <"$work/libraries"

[[ $("$program" --version | head -n 1) == "pathlight $version" ]] || fail "--version is not $version"
grep -qF "pathlight $version" "$installed/share/man/man1/pathlight.1" || fail "the manual page is not of $version"
grep -qx "version: $version" "$root/CITATION.cff" || fail "CITATION.cff is not of $version"
grep -qF "## [$version]" "$root/CHANGELOG.md" || fail "CHANGELOG.md has no $version"

# Every option of every help text is in the manual page and in the completions, and so is every subcommand.
man=$(sed 's/\\-/-/g; s/\\f[BIR]//g' "$installed/share/man/man1/pathlight.1")
zsh=$(<"$installed/share/zsh/site-functions/_pathlight")
export PATH="$work/moved/bin:$PATH"
# shellcheck source=/dev/null
source "$installed/share/bash-completion/completions/pathlight"
compopt() { :; }  # is for a shell that completes
# complete_words WORD...: the answers for the last word.
complete_words() {
    COMP_WORDS=(pathlight "$@") COMP_CWORD=$#
    COMPREPLY=()
    _pathlight
    printf '%s\n' "${COMPREPLY[@]}"
}
has_line() { grep -qxF -e "$1"; }
# `help` is a word before a subcommand, not one with options of its own.
commands=$("$program" --help | sed -n 's/^  pathlight \[*\([a-z]*\).*/\1/p' | grep -vx help)
[[ $(wc -w <<<"$commands") -gt 10 ]] || fail "--help has the subcommands '$commands'"
for command in $commands; do
    complete_words "${command:0:2}" | has_line "$command" || fail "bash does not complete $command"
    [[ $man == *$'\n'"$command"* ]] || fail "the manual page lacks $command"
    [[ $zsh == *"'$command:"* ]] || fail "zsh does not complete $command"
    answers=$(complete_words "$command" --)
    options=$("$program" "$command" --help-all | grep -oE '^  (-[a-z], )?--[a-z-]+' | grep -oE -e '--[a-z-]+')
    [[ $(wc -w <<<"$options") -gt 1 ]] || fail "the help of $command has the options '$options'"
    for option in $options --help --version --list-methods --list-views --licenses; do
        has_line "$option" <<<"$answers" || fail "bash does not complete $command $option"
        [[ $man == *"$option"[^a-z-]* ]] || fail "the manual page lacks $option"
        [[ $zsh == *"$option"[^a-z-]* ]] || fail "zsh does not complete $option"
    done
done
complete_words render co | has_line cornell || fail 'bash completes no scenes'
complete_words render --method re | has_line reinforcement || fail 'bash completes no methods'
complete_words render --nee of | has_line off || fail 'bash completes no words of options'
(cd "$root" && complete_words render -o REA | has_line README.md) || fail 'bash completes no files'
if command -v zsh >/dev/null; then
    zsh -n "$installed/share/zsh/site-functions/_pathlight" || fail 'zsh does not read its completion'
fi
if command -v groff >/dev/null; then
    said=$(groff -man -ww -Tutf8 -z "$installed/share/man/man1/pathlight.1" 2>&1)
    [[ -z $said ]] || fail "groff says of the manual page: $said"
fi
desktop="$installed/share/applications/pathlight.desktop"
if [[ -e $desktop ]]; then
    icon=$(sed -n 's/^Icon=//p' "$desktop")
    [[ -s $installed/share/icons/hicolor/scalable/apps/$icon.svg ]] || fail "there is no icon $icon"
fi
exit $((failures > 0))
