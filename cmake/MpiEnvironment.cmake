# Open MPI in a container or a small virtual machine: run as root, more ranks than cores, one thread a rank.
set(SLIPSCALE_MPI_ENVIRONMENT
  OMPI_ALLOW_RUN_AS_ROOT=1
  OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  OMPI_MCA_rmaps_base_oversubscribe=1
  OMPI_MCA_mpi_yield_when_idle=1
  OMPI_MCA_btl_vader_single_copy_mechanism=none
  OMPI_MCA_pml=ob1 # all ranks are here: no network is looked for, which takes .2 s a start
  ASAN_OPTIONS=detect_leaks=0 # Open MPI keeps memory until the process ends
  OMP_NUM_THREADS=1
  OPENBLAS_NUM_THREADS=1)
