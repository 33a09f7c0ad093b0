use proptest::prelude::*;

use super::*;

/// Of up to five words; zeros, powers of two and words of ones are frequent, for carries.
fn entry() -> impl Strategy<Value = BigInt> {
    let word = prop_oneof![Just(0), Just(u64::MAX), Just(1 << 63), any::<u64>()];
    (any::<bool>(), proptest::collection::vec(word, 0..5)).prop_map(|(negative, words)| {
        let magnitude = words.iter().fold(BigInt::from(0), |sum, &word| (sum << 64) + word);
        if negative { -magnitude } else { magnitude }
    })
}

fn matrix(rows: usize, columns: usize) -> impl Strategy<Value = Matrix<BigInt>> {
    proptest::collection::vec(entry(), rows * columns)
        .prop_map(move |entries| Matrix::from_fn(rows, columns, |i, j| entries[i * columns + j].clone()))
}

fn packed(matrix: &Matrix<BigInt>) -> Packed {
    Packed::of(matrix, 0)
}

/// The mantissas over 2^least.
fn over(matrix: &Packed, least: i64) -> Matrix<BigInt> {
    let places = matrix.exponent - least;
    matrix.mantissas().map(|entry| if entry.is_zero() { BigInt::zero() } else { entry << places })
}

proptest! {
    /// Sums of products of single integers say what is right.
    #[test]
    fn products_are_sums_of_products((a, b, m) in (1..4_usize, 0..4_usize, 1..4_usize).prop_flat_map(|(r, k, c)| {
        (matrix(r, k), matrix(k, c), matrix(k, k))
    })) {
        let sum = |i: usize, j: usize| (0..b.rows()).map(|k| &a[(i, k)] * &b[(k, j)]).sum::<BigInt>();
        let product = Matrix::from_fn(a.rows(), b.columns(), sum);
        prop_assert_eq!(packed(&a).times(&packed(&b)).mantissas(), product.clone());
        prop_assert_eq!(packed(&a).times_transposed(&packed(&b).transposed()).mantissas(), product);
        let middle = &m + &m.transpose();
        let all = || (0..a.columns()).flat_map(|k| (0..a.columns()).map(move |l| (k, l)));
        let term = |i: usize, j: usize| all().map(|(k, l)| &a[(i, k)] * &middle[(k, l)] * &a[(j, l)]).sum::<BigInt>();
        let congruence = packed(&a).congruence(&packed(&middle));
        prop_assert_eq!(congruence.mantissas(), Matrix::from_fn(a.rows(), a.rows(), term));
        let square = |i: usize, j: usize| (0..a.columns()).map(|k| &a[(i, k)] * &a[(j, k)]).sum::<BigInt>();
        prop_assert_eq!(packed(&a).square().mantissas(), Matrix::from_fn(a.rows(), a.rows(), square));
    }

    /// Sums, differences and multiples are those of the entries, whatever the exponents.
    #[test]
    fn sums_are_those_of_the_entries(
        (a, b) in (0..4_usize, 1..4_usize).prop_flat_map(|(r, c)| (matrix(r, c), matrix(r, c))),
        (p, q) in (-150..150_i64, -150..150_i64), factor in entry(),
    ) {
        let (x, y, least) = (Packed::of(&a, p), Packed::of(&b, q), p.min(q));
        let lifted = |matrix: &Matrix<BigInt>, exponent: i64| matrix.map(|entry| entry << (exponent - least));
        prop_assert_eq!(over(&x.plus(&y), least), lifted(&a, p) + lifted(&b, q));
        prop_assert_eq!(over(&x.minus(&y), least), lifted(&a, p) - lifted(&b, q));
        prop_assert_eq!(x.scaled(&factor).mantissas(), a.map(|entry| entry * &factor));
        let multiple = x.multiple(&Dyadic::new(factor.clone(), q));
        prop_assert_eq!(over(&multiple, p + q), a.map(|entry| entry * &factor));
        prop_assert_eq!(x.squared_norm(), Dyadic::new(a.entries().iter().map(|entry| entry * entry).sum(), 2 * p));
        let magnitudes = |i: usize| a.row(i).iter().map(|entry| BigInt::from(entry.magnitude().clone())).sum::<BigInt>();
        let largest = (0..a.rows()).map(magnitudes).max().unwrap_or_default();
        prop_assert_eq!(x.largest_row_sum(), Dyadic::new(largest, p));
        prop_assert_eq!(x.dyadics().mantissas, a);
    }

    /// What is known to be symmetric gives the same by its triangle, also beside what is not.
    #[test]
    fn triangles_are_enough(
        (a, b, more) in (1..4_usize).prop_flat_map(|n| (matrix(n, n), matrix(n, n), proptest::collection::vec(entry(), n))),
        factor in entry(),
    ) {
        let twice = [&a, &b].map(|matrix| matrix + &matrix.transpose());
        let [x, y] = [0, 1].map(|k| packed(&twice[k]).symmetric());
        prop_assert_eq!(x.plus(&y).mantissas(), &twice[0] + &twice[1]);
        prop_assert_eq!(x.minus(&y).mantissas(), &twice[0] - &twice[1]);
        prop_assert_eq!(x.plus(&packed(&b)).mantissas(), &twice[0] + &b);
        prop_assert_eq!(packed(&b).minus(&x).mantissas(), &b - &twice[0]);
        prop_assert_eq!(x.scaled(&factor).mantissas(), twice[0].map(|entry| entry * &factor));
        prop_assert_eq!(x.plus_diagonal(&more).mantissas(), &twice[0] + Matrix::diagonal(&more));
        prop_assert_eq!(x.transposed().mantissas(), twice[0].clone());
    }

    /// A symmetric sum with products.
    #[test]
    fn products_are_added(
        (a, b, m) in (1..4_usize, 0..3_usize).prop_flat_map(|(n, k)| (matrix(n, k), matrix(n, k), matrix(n, n))),
        (p, q, r, s) in (-150..150_i64, -90..90_i64, -90..90_i64, -90..90_i64),
    ) {
        let (prior, n) = (&m + &m.transpose(), a.rows());
        // m + a bᵀ + b aᵀ, and m + a aᵀ − b bᵀ
        let term = |x: &Matrix<BigInt>, y: &Matrix<BigInt>, i, j| (0..x.columns()).map(|k| &x[(i, k)] * &y[(j, k)]).sum::<BigInt>();
        let least = p.min(q + r).min(2 * q).min(2 * r).min(q + s).min(r + s);
        let lifted = |value: BigInt, exponent: i64| value << (exponent - least);
        let x = Packed::of(&prior, p);
        let both = x.with_products((&Packed::of(&a, q), &Packed::of(&b, r)), (&Packed::of(&b, r), &Packed::of(&-&a, q)));
        let sum = |i, j| lifted(prior[(i, j)].clone(), p) + lifted(term(&a, &b, i, j) + term(&b, &a, i, j), q + r);
        prop_assert_eq!(over(&both, least), Matrix::from_fn(n, n, sum));
        let squares = x.with_products((&Packed::of(&a, q), &Packed::of(&a, q)), (&Packed::of(&b, r), &Packed::of(&b, r)));
        let sum = |i, j| lifted(prior[(i, j)].clone(), p) + lifted(term(&a, &a, i, j), 2 * q) - lifted(term(&b, &b, i, j), 2 * r);
        prop_assert_eq!(over(&squares, least), Matrix::from_fn(n, n, sum));
    }

    /// The diagonal, its sum, and what is added to it.
    #[test]
    fn diagonals_are_those_of_the_entries(
        (a, more) in (1..4_usize).prop_flat_map(|n| (matrix(n, n), proptest::collection::vec(entry(), n))), p in -9..9_i64,
    ) {
        let x = Packed::of(&a, p);
        let diagonal: Vec<BigInt> = (0..a.rows()).map(|i| a[(i, i)].clone()).collect();
        prop_assert_eq!(x.trace(), Dyadic::new(diagonal.iter().sum(), p));
        prop_assert_eq!(x.diagonal(), diagonal.into_iter().map(|entry| Dyadic::new(entry, p)).collect::<Vec<_>>());
        prop_assert_eq!(x.plus_diagonal(&more).mantissas(), &a + Matrix::diagonal(&more));
        prop_assert_eq!(Packed::identity(a.rows()).mantissas(), Matrix::<BigInt>::identity(a.rows()));
    }

    /// Entries are rounded as single integers are.
    #[test]
    fn entries_go_to_their_units(
        (a, units) in (1..4_usize).prop_flat_map(|n| (matrix(n, n), proptest::collection::vec(-90..200_i64, n))),
        p in -150..150_i64, odd in prop_oneof![Just(1), Just(3), Just(1025)], is_symmetric in any::<bool>(),
    ) {
        let odd = BigInt::from(odd);
        let a = if is_symmetric { &a + &a.transpose() } else { a };
        let least = 2 * units.iter().min().copied().unwrap_or(0);
        let unit = |i: usize, j: usize| units[i] + units[j];
        let mut exact = Matrix::from_fn(a.rows(), a.rows(), |_, _| None);
        let rounded = Packed::of(&a, p).to_units(&odd, (least, unit), is_symmetric, |i, j, is_exact| {
            exact[(i, j)] = Some(is_exact);
        });
        prop_assert_eq!(rounded.exponent, least);
        for (i, j) in (0..a.rows()).flat_map(|i| (0..a.rows()).map(move |j| (i, j))) {
            let (whole, is_exact) = super::super::grid::nearest(&a[(i, j)], p - unit(i, j), &odd);
            prop_assert_eq!(rounded.mantissa(i, j), whole << (unit(i, j) - least));
            let is_told = !is_symmetric || j <= i;
            prop_assert_eq!(exact[(i, j)], is_told.then_some(is_exact));
        }
    }
}

/// Past the bound the other way gives the same.
#[test]
fn long_integers_too() {
    let long = |shift: usize| (BigInt::from(3) << (64 * MOST_WORDS + shift)) - 1;
    let a = Matrix::from_fn(2, 2, |i, j| long(i + 2 * j));
    let sum = |i: usize, j: usize| &a[(i, 0)] * &a[(0, j)] + &a[(i, 1)] * &a[(1, j)];
    let product = Matrix::from_fn(2, 2, sum);
    assert_eq!(packed(&a).times(&packed(&a)).mantissas(), product);
    assert_eq!(packed(&a).times_transposed(&packed(&a).transposed()).mantissas(), product);
    let square = |i: usize, j: usize| &a[(i, 0)] * &a[(j, 0)] + &a[(i, 1)] * &a[(j, 1)];
    assert_eq!(packed(&a).square().mantissas(), Matrix::from_fn(2, 2, square));
    assert_eq!(packed(&a).scaled(&long(1)).mantissas(), a.map(|entry| entry * long(1)));
    let norm = a.entries().iter().map(|entry| entry * entry).sum();
    assert_eq!(packed(&a).squared_norm(), Dyadic::new(norm, 0));
}
