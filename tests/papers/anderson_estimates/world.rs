//! The system AK-1.1, AK-1.2 with every variable written out in its sources.
//!
//! A vector of variables is a matrix: column 0 holds its constant part, the other columns its coefficients on sources
//! that are uncorrelated, of mean 0 and variance 1. So E[X Yᵀ] is the product of the two matrices, whatever the law of
//! the sources.

use exact_kalman::matrix::Matrix;

use super::numbers::{Draws, Q, power};

pub struct World {
    pub a: Q,
    /// V = v_root v_rootᵀ, and so on.
    pub v_root: Q,
    pub w_root: Q,
    pub x_root: Q,
    pub x_mean: Q,
    /// v(−past), …, v(last) and w(1), …, w(last) exist.
    pub past: usize,
    pub last: usize,
}

impl World {
    pub fn drawn(draws: &mut Draws, p: usize, past: usize, last: usize) -> Self {
        let ranks = [p, p, p].map(|most| 1 + usize::try_from(draws.integer(4).unsigned_abs()).unwrap_or(0) % most);
        Self {
            a: draws.matrix(p, p),
            v_root: draws.matrix(p, ranks[0]),
            w_root: draws.matrix(p, ranks[1]),
            x_root: draws.matrix(p, ranks[2]),
            x_mean: draws.matrix(p, 1),
            past,
            last,
        }
    }

    pub fn p(&self) -> usize {
        self.a.rows()
    }

    pub fn v_covariance(&self) -> Q {
        &self.v_root * self.v_root.transpose()
    }

    pub fn w_covariance(&self) -> Q {
        &self.w_root * self.w_root.transpose()
    }

    pub fn sources(&self) -> usize {
        1 + self.x_root.columns()
            + (self.past + self.last + 1) * self.v_root.columns()
            + self.last * self.w_root.columns()
    }

    fn placed(&self, root: &Q, first: usize) -> Q {
        let after = self.sources() - first - root.columns();
        Matrix::zeros(self.p(), first).beside(root).beside(&Matrix::zeros(self.p(), after))
    }

    pub fn zero(&self) -> Q {
        Matrix::zeros(self.p(), self.sources())
    }

    pub fn x0(&self) -> Q {
        self.placed(&self.x_mean, 0) + self.placed(&self.x_root, 1)
    }

    /// v(k), k from −past to last; nothing elsewhere.
    pub fn v(&self, k: i64) -> Option<Q> {
        let index = usize::try_from(k + i64::try_from(self.past).ok()?).ok()?;
        (index <= self.past + self.last)
            .then(|| self.placed(&self.v_root, 1 + self.x_root.columns() + index * self.v_root.columns()))
    }

    /// w(k), k from 1 to last; nothing elsewhere.
    pub fn w(&self, k: i64) -> Option<Q> {
        let index = usize::try_from(k - 1).ok()?;
        let first = 1 + self.x_root.columns() + (self.past + self.last + 1) * self.v_root.columns();
        (index < self.last).then(|| self.placed(&self.w_root, first + index * self.w_root.columns()))
    }

    pub fn noise(&self, k: i64) -> Q {
        self.v(k).unwrap_or_else(|| panic!("no v({k})"))
    }

    pub fn observation_noise(&self, k: i64) -> Q {
        self.w(k).unwrap_or_else(|| panic!("no w({k})"))
    }

    /// x(k), by the recursion AK-1.1.
    pub fn x(&self, k: i64) -> Q {
        (0..k).fold(self.x0(), |x, j| &self.a * x + self.noise(j))
    }

    /// y(k), by AK-1.2.
    pub fn y(&self, k: i64) -> Q {
        self.x(k) + self.observation_noise(k)
    }

    /// z(k) = w(k) + v(k−1) − Aw(k−1)
    pub fn z(&self, k: i64) -> Q {
        self.observation_noise(k) + self.noise(k - 1) - &self.a * self.observation_noise(k - 1)
    }

    /// u(k) = w(k) + Σ_{j≥0} Aʲv(k−j−1), with the past cut off at v(−past): complete if A^(k+past) = 0.
    pub fn u(&self, k: i64) -> Q {
        let terms = (0..).map_while(|j| self.v(k - j - 1).map(|v| (j, v)));
        terms.fold(self.observation_noise(k), |u, (j, v)| u + power(&self.a, usize::try_from(j).unwrap_or(0)) * v)
    }

    /// q(k) = Aᵏ(Σ_{j≥0} Aʲv(−j−1) − x(0)), cut off likewise.
    pub fn q(&self, k: usize) -> Q {
        let terms = (0..self.past).map(|j| power(&self.a, j) * self.noise(-1 - i64::try_from(j).unwrap_or(0)));
        let sum = terms.fold(self.zero(), |sum, term| sum + term);
        power(&self.a, k) * (sum - self.x0())
    }
}

/// E[X Yᵀ]
pub fn moment(x: &Q, y: &Q) -> Q {
    x * y.transpose()
}

/// E X
pub fn mean(x: &Q) -> Q {
    x.block(0..x.rows(), 0..1)
}

/// cov(X, Y)
pub fn covariance(x: &Q, y: &Q) -> Q {
    moment(x, y) - mean(x) * mean(y).transpose()
}
