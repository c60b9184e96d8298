# Faces of a periodic box that move: once they have come as far as a neighbour list reaches beyond contact, it is made again, also
# where all grains are at rest.
mend(neighbor.cpp "delta = 0.5 * (skin - (delta1+delta2));" "delta = 0.5 * (skin - (delta1+delta2));
      if (delta <= 0.0) return 1;"
     "grains at rest pass through each other across periodic faces that close in")
