// Writes tests/fuzz/corpus/field and checkpoint, the corpora of the fuzzers of these files. Built and run by hand when the version
// of the files changes; fuzz_corpus_test.cpp fails until then. Usage: make_sealed_corpora CORPORA
#include <iostream>

#include "core/io/field_file.h"
#include "core/io/files.h"
#include "tests/support/field/small_checkpoint.h"
#include "tests/support/field/small_field.h"

using namespace pl;

namespace {

void write_fields(const std::filesystem::path& folder) {
    write_field(folder / "small", test::small_field());
    LearnedField empty = test::small_field();
    empty.volumes = std::make_shared<const HostVolumes>();
    empty.field = {};
    empty.refinement = {};
    empty.progress.next_probe = 0;
    write_field(folder / "empty", empty);
    const std::string bytes = read_file(folder / "small");
    write_file_atomic(folder / "cut", std::string_view(bytes).substr(0, bytes.size() / 2));
    write_file_atomic(folder / "other", "PLFIELD\nno field");
}

void write_checkpoints(const std::filesystem::path& folder) {
    const Checkpoint small = test::small_checkpoint();
    write_checkpoint(folder / "small", small);
    Checkpoint unplaced = small;
    unplaced.state.placement.reset();
    unplaced.state.fields.clear();
    write_checkpoint(folder / "unplaced", unplaced);
    const std::string bytes = read_file(folder / "small");
    write_file_atomic(folder / "cut", std::string_view(bytes).substr(0, bytes.size() / 2));
    write_file_atomic(folder / "other", "PLCHECK\nno checkpoint");
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::cerr << "usage: make_sealed_corpora CORPORA\n";
        return 2;
    }
    try {
        const std::filesystem::path corpora = arguments[1];
        write_fields(corpora / "field");
        write_checkpoints(corpora / "checkpoint");
    } catch (const std::exception& error) {
        std::cerr << "make_sealed_corpora: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
