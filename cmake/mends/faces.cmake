# Faces of a periodic box that move: once they have moved as far as the neighbour list reaches beyond contact, the list
# is built again, also when all grains are at rest.
mend(neighbor.cpp "delta = 0.5 * (skin - (delta1+delta2));" "delta = 0.5 * (skin - (delta1+delta2));
      if (delta <= 0.0) return 1;"
     "grains at rest pass through each other where periodic faces approach")
