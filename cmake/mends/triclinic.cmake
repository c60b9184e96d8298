# Triclinic boxes that lose grains.

mend(domain.cpp "prd_lamda[0] = prd_lamda[1] = prd_lamda[2] = 0.0;" "prd_lamda[0] = prd_lamda[1] = prd_lamda[2] = 1.0;"
     "prd_lamda is 0, which loses atoms of triclinic boxes")
mend(domain.cpp "prd_half_lamda[0] = prd_half_lamda[1] = prd_half_lamda[2] = 0.0;"
     "prd_half_lamda[0] = prd_half_lamda[1] = prd_half_lamda[2] = 0.5;" "prd_half_lamda is 0 likewise")

# When a box has moved since the last neighbour list, grains may lie outside it: they go to the rank of their image, and
# are wrapped, with their velocities, when the run begins.
mend(read_restart.cpp "\n        if (coord[0] >= sublo[0] && coord[0] < subhi[0] &&" "
        double inside[3];
        for (int k = 0; k < 3; k++) {
          const double lo = triclinic ? 0.0 : domain->boxlo[k], hi = triclinic ? 1.0 : domain->boxhi[k];
          inside[k] = coord[k];
          if (!domain->periodicity[k] || (coord[k] >= lo && coord[k] < hi)) continue;
          inside[k] -= (hi - lo) * floor((coord[k] - lo) / (hi - lo));
          if (inside[k] < lo || inside[k] >= hi) inside[k] = lo;
        }
        coord = inside;
        if (coord[0] >= sublo[0] && coord[0] < subhi[0] &&"
     "a restart file written during a run loses grains beyond a face of a moving box")
