# A program without a screen.

# LIGGGHTS checks in most places whether there is a screen before it prints; some forty places do not. They print to
# /dev/null.
mend(lammps.cpp "\n  // check datatype settings in lmptype.h\n" "
  if (!screen) screen = fopen(\"/dev/null\",\"w\");

  // check datatype settings in lmptype.h
" "-screen none crashes where LIGGGHTS prints without a check for a screen")
