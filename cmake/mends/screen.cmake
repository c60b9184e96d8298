# A program without a screen.

# Most of the host asks whether there is a screen before it prints; some forty places do not. They get /dev/null.
mend(lammps.cpp "\n  // check datatype settings in lmptype.h\n" "
  if (!screen) screen = fopen(\"/dev/null\",\"w\");

  // check datatype settings in lmptype.h
" "-screen none crashes where the host prints without asking for a screen")
