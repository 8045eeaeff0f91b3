(** * One tactic for all cases

    Claim.  None of its own: [prove_case] proves statements of the form

      0 <= D <= length ->
      is_RInt (extinction_along field extinction) 0 D (depth D) /\
      is_RInt (integrand field extinction emission) 0 D (radiance D)

    for functions made of polynomials, quotients, exp, ln, sin, cos, tan, sinh,
    cosh, tanh, atan, erf and square roots of constants.

    Why.  The program writes one such statement a case; nobody writes proofs for them.

    How.  By Integral.v it is enough that depth and radiance vanish at 0 and have the
    right derivatives.  [auto_derive] differentiates; what is left are side conditions,
    such as denominators that do not vanish, and equations between elementary functions.
    Those are settled by [field] once exponentials of the same number are the same term. *)

From Coq Require Export Reals Lra.
From Coquelicot Require Export Coquelicot.
From Volver Require Export Integral Erf.
Open Scope R_scope.

(** ** What is looked up *)

Lemma exp_multiple (p : positive) (x : R) : exp (IZR (Zpos p) * x) = exp x ^ Pos.to_nat p.
Proof.
  change (IZR (Zpos p)) with (IPR p). rewrite <- INR_IPR.
  induction (Pos.to_nat p) as [| n IH]; [simpl; now rewrite Rmult_0_l, exp_0 |].
  rewrite S_INR, Rmult_plus_distr_r, exp_plus, IH, Rmult_1_l. simpl. ring.
Qed.

Lemma cos_square (x : R) : cos x ^ 2 = 1 - sin x ^ 2.
Proof. rewrite <- !Rsqr_pow2. apply cos2. Qed.

Lemma tanh_0 : tanh 0 = 0.
Proof. unfold tanh. rewrite sinh_0. apply Rmult_0_l. Qed.

Lemma tanh_opp (x : R) : tanh (- x) = - tanh x.
Proof.
  unfold tanh, sinh, cosh. rewrite Ropp_involutive. field.
  apply Rgt_not_eq, Rplus_lt_0_compat; apply exp_pos.
Qed.

(** ** Side conditions: what a quotient, a logarithm or a square root needs *)

Ltac sin_and_cos_bounds :=
  repeat match goal with
  | |- context [sin ?x] =>
      lazymatch goal with _ : -1 <= sin x <= 1 |- _ => fail | _ => pose proof (SIN_bound x) end
  | |- context [cos ?x] =>
      lazymatch goal with _ : -1 <= cos x <= 1 |- _ => fail | _ => pose proof (COS_bound x) end
  end.

Ltac positive :=
  first
  [ lra
  | apply exp_pos
  | apply PI_RGT_0
  | apply sqrt_lt_R0; positive
  | apply Rplus_lt_0_compat; positive
  | apply Rmult_lt_0_compat; positive
  | apply Rinv_0_lt_compat; positive
  | apply pow_lt; positive
  | match goal with |- 0 < ?a + ?x * (?x * 1) => assert (0 <= x * x) by apply Rle_0_sqr; lra end
  (* Before pi/2, which is more than 1. *)
  | apply cos_gt_0; assert (H := PI2_1); lra
  | progress sin_and_cos_bounds; lra
  | lazymatch goal with |- context [exp _] => fail | _ => nra end ].

Ltac side :=
  repeat match goal with
  | |- _ /\ _ => split
  | |- True => exact I
  | |- _ > 0 => unfold Rgt
  | |- 0 < _ => positive
  | |- _ <> 0 => first
    [ apply Rgt_not_eq; unfold Rgt; positive
    | apply pow_nonzero
    | apply Rmult_integral_contrapositive_currified ]
  end.

(** ** Equations between elementary functions *)

(** An identity of rational functions, of sin and cos of one number with sin^2 + cos^2 = 1,
    or with the square root of one number. *)
Ltac algebra :=
  first
  [ ring
  | field; solve [side]
  | match goal with |- context [sin ?x] =>
      let H := fresh in pose proof (cos_square x) as H; field [H]; solve [side]
    end
  | match goal with |- context [sqrt ?x] =>
      let H := fresh in
      assert (H : sqrt x ^ 2 = x) by (apply pow2_sqrt; left; positive);
      field [H]; solve [side]
    end ].

(** Arguments of [f] that are the same number become the same term. *)
Ltac one_argument f :=
  repeat match goal with |- context [f ?a] =>
    match goal with |- context [f ?b] =>
      tryif constr_eq a b then fail else replace b with a by algebra
    end
  end.

(** exp(t) stands for every exponential that is its equal or its inverse. *)
Ltac one_exponential t :=
  repeat match goal with |- context [exp ?a] =>
    tryif constr_eq a t then fail else
    first [ replace a with t by algebra | replace a with (- t) by algebra; rewrite (exp_Ropp t) ]
  end.

(** An exponential that is exp(t) but for a factor exp(c) which occurs as well. *)
Ltac factor_out t :=
  match goal with |- context [exp ?c] =>
    match goal with |- context [exp ?a] =>
      replace a with (t + - c) by algebra; rewrite (exp_plus t (- c)), (exp_Ropp c)
    end
  end.

(** The exponential of a sum as a product. *)
Ltac split_sums :=
  repeat match goal with
  | |- context [exp (?a + ?b)] => rewrite (exp_plus a b)
  | |- context [exp (?a - ?b)] => replace (a - b) with (a + - b) by ring
  | |- context [exp (- (?a + ?b))] => rewrite (Ropp_plus_distr a b)
  | |- context [exp (- (?a - ?b))] => rewrite (Ropp_minus_distr a b)
  | |- context [exp (?a * (?b + ?c))] => rewrite (Rmult_plus_distr_l a b c)
  | |- context [exp (?a * (?b - ?c))] => rewrite (Rmult_minus_distr_l a b c)
  | |- context [exp (- ?a * ?b)] => replace (- a * b) with (- (a * b)) by ring
  | |- context [exp (- ?a)] => rewrite (exp_Ropp a)
  | |- context [exp (IZR (Zneg ?p) * ?x)] =>
      replace (IZR (Zneg p) * x) with (- (IZR (Zpos p) * x)) by ring
  | |- context [exp (IZR (Zneg ?p))] => change (IZR (Zneg p)) with (- IZR (Zpos p))
  | |- context [exp (ln ?x)] => rewrite (exp_ln x) by positive
  end.

(** The exponential of a whole multiple as a power. *)
Ltac split_multiples :=
  repeat match goal with
  | |- context [exp (IZR (Zpos ?p) * ?x)] =>
      rewrite (exp_multiple p x);
      let n := eval compute in (Pos.to_nat p) in change (Pos.to_nat p) with n
  | |- context [exp (ln ?x)] => rewrite (exp_ln x) by positive
  end.

Ltac split_square_roots :=
  repeat match goal with
  | |- context [sqrt (?a * ?b)] => rewrite (sqrt_mult a b) by (left; positive)
  | |- context [sqrt (?a / ?b)] => rewrite (sqrt_div a b) by (first [positive | left; positive])
  | |- context [sqrt 1] => rewrite sqrt_1
  end.

Ltac equation :=
  simpl; split_square_roots; unfold Rminus, Rdiv;
  one_argument erf; one_argument atan; one_argument ln;
  first
  [ algebra
  | split_sums; algebra
  | match goal with |- _ = _ * exp ?t => one_exponential t end;
    first [ algebra | split_sums; algebra ]
  | match goal with |- _ = _ * exp ?t => factor_out t end; algebra
  | split_sums; split_multiples; algebra ].

(** ** The six parts of [manufactured] *)

Ltac elementary := unfold tanh, tan, cosh, sinh.

Ltac continuity :=
  apply (ex_derive_continuous (V := R_NormedModule)); elementary; auto_derive; side.

Ltac derivative := elementary; auto_derive; [side .. | unfold Rsqr; equation].

Ltac identity := first [ algebra | split_sums; algebra ].

Ltac at_0 :=
  simpl; split_square_roots; unfold Rminus, Rdiv;
  repeat rewrite ?Rmult_0_l, ?Rmult_0_r, ?Rmult_1_l, ?Rmult_1_r, ?Rplus_0_l, ?Rplus_0_r, ?Ropp_0,
    ?exp_0, ?ln_1, ?sin_0, ?cos_0, ?tan_0, ?sinh_0, ?cosh_0, ?tanh_0, ?atan_0, ?erf_0, ?sqrt_0,
    ?tanh_opp, ?atan_opp, ?erf_opp;
  first
  [ algebra
  | repeat match goal with
    | |- context [ln ?a] => replace a with 1 by identity; rewrite ln_1
    | |- context [exp ?a] => replace a with 0 by algebra; rewrite exp_0
    end;
    identity ].

Tactic Notation "part" string(failure) tactic3(proof) :=
  first [ solve [proof] | fail 1 failure ].

(** All of a case.  Says which part stays open, so that [Qed] is not what finds out. *)
Ltac prove_case :=
  lazymatch goal with
  | |- 0 <= ?D <= ?length -> is_RInt (extinction_along ?s ?tau) 0 ?D (?t ?D) /\
                             is_RInt (integrand ?s ?tau ?C) 0 ?D (?I ?D) =>
    let H := fresh in
    intros H; refine (manufactured_integrals s tau C t I length _ D H); clear H;
    split; unfold extinction_along, source, s, tau, C, t, I;
    [ intros l Hl; part "tau is not seen to be continuous on the ray" continuity
    | intros l Hl; part "C tau is not seen to be continuous on the ray" continuity
    | intros l Hl; part "the derivative of the depth is not seen to be tau" derivative
    | intros l Hl; part "the derivative of the radiance is not seen to be C tau exp(-t)" derivative
    | part "the depth is not seen to be 0 at 0" at_0
    | part "the radiance is not seen to be 0 at 0" at_0 ]
  end.
