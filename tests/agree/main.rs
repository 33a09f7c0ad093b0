//! Every algorithm by two routes: recursion, one-shot conditioning, other scalars, exact finite laws.

mod diffuse;
mod draws;
mod fraction_free;
mod gain;
mod moments;
mod one_shot;
mod past;
mod residues;
mod systems;
