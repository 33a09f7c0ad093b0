//! Every algorithm by two routes: recursion, one-shot conditioning, other scalars, exact finite laws.

mod diffuse;
mod fraction_free;
mod moments;
mod one_shot;
mod residues;
mod systems;
