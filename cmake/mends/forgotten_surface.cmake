# Superquadrics that collide as spheres.

set(settings "\n    inline void postSettings(IContactHistorySetup * hsetup, ContactModelBase *cmb)\n    {\n")
mend(surface_model_default.h "${settings}" "${settings}        int rank;
        MPI_Comm_rank(world, &rank);
        if (!cmb->is_wall() && atom->superquadric_flag && rank == 0)
            error->warning(FLERR, \"grains of atom_style superquadric without a surface model collide as their \"
                                  \"bounding spheres: add 'surface superquadric', or 'surface ellipsoid' where \"
                                  \"every blockiness is 2\");
" "superquadrics without a surface model collide as their bounding spheres, without a warning")
