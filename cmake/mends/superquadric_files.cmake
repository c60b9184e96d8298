# Data files of superquadrics. src/ATOM knows what their lines hold: here LIGGGHTS calls it, and reads lines of their
# length.

mend(atom_vec.h "\n  virtual void data_atom(double *, tagint, char **) = 0;" "
  virtual int columns_of_atoms(int, char *) {return size_data_atom;}
  virtual void check_velocities(int, char *) {}
  virtual void data_atom(double *, tagint, char **) = 0;" "the atom style cannot read the lines of a data file itself")
mend(atom.cpp "\n  if (nwords != avec->size_data_atom && nwords != avec->size_data_atom + 3)" "
  const int columns = avec->columns_of_atoms(n,buf);
  if (nwords != columns && nwords != columns + 3)" "a data file cannot have optional columns")
mend(atom.cpp "\n  if (nwords > avec->size_data_atom) imageflag = 1;" "\n  if (nwords > columns) imageflag = 1;"
     "image flags behind optional columns are not found")
mend(atom.cpp "\n  if (nwords != avec->size_data_vel)" "
  avec->check_velocities(n,buf);
  if (nwords != avec->size_data_vel)" "the atom style cannot check the velocities of a data file")
mend(read_data.cpp "\n#define MAXLINE 256\n" "\n#define MAXLINE 1024\n"
     "lines of a data file are cut after 255 characters")
