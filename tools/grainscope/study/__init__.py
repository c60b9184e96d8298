"""A study: its plan, its runs, and the tables, fits and figures that are made of them."""
