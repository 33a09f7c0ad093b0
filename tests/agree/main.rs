//! Every algorithm by two routes: recursion, one-shot conditioning, other scalars, exact finite laws.

mod absence;
mod ahead;
mod averages;
mod bayes;
mod bayes_digits;
mod beyond;
mod certified;
mod diffuse;
mod draws;
mod feedback;

mod gain;
mod growth;
mod identify;
mod measurable;
mod moments;
mod multimodular;
mod nongaussian;
mod one_shot;
mod past;
mod prediction_error;
mod quadrature;
mod random_modes;
mod rational_routes;
mod residues;
#[cfg(feature = "judge")]
mod steady;
mod systems;
mod timing;
mod tower;
