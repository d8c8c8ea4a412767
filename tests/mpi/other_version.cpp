// A program of another version, as a rank of a job with pathlight.
#include "core/base/error.h"
#include "mpi/job.h"

int main() {
    try {
        pl::join_job("pathlight of another version");
    } catch (const pl::Error& error) {
        return static_cast<int>(error.kind());
    }
    return 0;
}
