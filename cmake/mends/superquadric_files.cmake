# Data files of superquadrics. What lines hold is in src/ATOM: the host asks it here, and reads lines as long as theirs.

mend(atom_vec.h "\n  virtual void data_atom(double *, tagint, char **) = 0;" "
  virtual int columns_of_atoms(int, char *) {return size_data_atom;}
  virtual void check_velocities(int, char *) {}
  virtual void data_atom(double *, tagint, char **) = 0;" "a data file's lines are not shown to the atom style")
mend(atom.cpp "\n  if (nwords != avec->size_data_atom && nwords != avec->size_data_atom + 3)" "
  const int columns = avec->columns_of_atoms(n,buf);
  if (nwords != columns && nwords != columns + 3)" "columns of a data file that may or may not be there")
mend(atom.cpp "\n  if (nwords > avec->size_data_atom) imageflag = 1;" "\n  if (nwords > columns) imageflag = 1;"
     "likewise")
mend(atom.cpp "\n  if (nwords != avec->size_data_vel)" "
  avec->check_velocities(n,buf);
  if (nwords != avec->size_data_vel)" "likewise, of velocities")
mend(read_data.cpp "\n#define MAXLINE 256\n" "\n#define MAXLINE 1024\n"
     "a data file's lines are cut after 255 characters")
