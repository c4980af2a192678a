// SPDX-License-Identifier: MIT
#include "ranks.hpp"

#ifdef VOUSSOIR_MPI
#include <mpi.h>
#else
#include <cstdlib>
#endif

namespace voussoir::program {

#ifdef VOUSSOIR_MPI

Ranks::Ranks(int& argc, char**& argv) {
  int given = 0;  // threads compute, the first one alone speaks to other processes
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &given);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}
Ranks::~Ranks() { MPI_Finalize(); }

int Ranks::largest(int value) const {
  int all = value;
  MPI_Allreduce(&value, &all, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return all;
}

std::string why_ranks_are_apart() { return ""; }

#else

Ranks::Ranks(int&, char**&) {}
Ranks::~Ranks() = default;
int Ranks::largest(int value) const { return value; }

std::string why_ranks_are_apart() {
  // As Open MPI, MPICH and Slurm's own srun say it.
  for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    const char* const size = std::getenv(name);
    if (size != nullptr && std::atoi(size) > 1)
      return std::string("this program was built without MPI, and mpirun has started it ") + size +
             " times\n   = accepted: a program built with -DVOUSSOIR_MPI=ON, or one process with "
             "--threads";
  }
  return "";
}

#endif

}  // namespace voussoir::program
