// Writes tests/fuzz/corpus/field, the corpus of the fuzzer of field files. Built and run by hand when the version of the
// files changes; corpus_test.cpp fails until then. Usage: make_field_corpus FOLDER
#include <iostream>

#include "core/io/field_file.h"
#include "core/io/files.h"
#include "tests/support/field/small_field.h"

using namespace pl;

namespace {

void write_corpus(const std::filesystem::path& folder) {
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

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::cerr << "usage: make_field_corpus FOLDER\n";
        return 2;
    }
    try {
        write_corpus(arguments[1]);
    } catch (const std::exception& error) {
        std::cerr << "make_field_corpus: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
